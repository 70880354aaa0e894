# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""What tools/measure-size makes of the answers of `size`, `nm` and its own programs, and the section of
docs/real_time.md that it writes."""

import re

import benchmark_page as page

HEADING = "## Code size, static storage, stack, memory"
MIB = 1024.0 * 1024.0
THREADS = ["radio", "frontend", "backend", "publisher", "recorder"]
LARGEST = 5


def sizes(text):
    """text, data and bss in bytes of the last line of what `size -t` says. Raises ValueError."""
    return [int(number) for number in text.strip().splitlines()[-1].split()[:3]]


def static_objects(text):
    """Name and bytes of the largest objects with an address of their own outside the code, from what
    `nm -C -S --size-sort` says; largest first."""
    found = re.findall(r"^\w+ (\w+) [bBdD] (.+)$", text, re.MULTILINE)
    return [(re.sub(r"\(anonymous namespace\)::|\([^()]*\)( const)?", "", name), int(size, 16))
            for size, name in reversed(found)][:LARGEST]


def fixed_parts(text):
    """Name and bytes in all of what tests/benchmarks/fixed_storage.cpp prints."""
    rows = (line.split("\t") for line in text.splitlines())
    return [(name, int(own) + int(heap)) for name, own, heap in rows]


def stack_depths(text):
    """By name of a thread: bytes below its first frame, and below its stack's top, from what
    tests/benchmarks/painted_stacks.cpp writes; of namesakes the deepest."""
    depths = {}
    for line in text.splitlines():
        name, own, whole, _ = line.split("\t")
        depths[name] = max(depths.get(name, (0, 0)), (int(own), int(whole)))
    return depths


def kilobytes(size):
    return f"{size / 1000.0:,.1f}"


def code_table(rows):
    """`rows`: name of a part; text, data, bss."""
    return page.table(["part", "code and constants, kB:", "data, kB:", "zeroed, kB:"],
                      [[name, *map(kilobytes, figures)] for name, figures in rows])


def stack_table(rows):
    """`rows`: name of an input, depths of its threads as stack_depths() has them."""
    return page.table(["input", *(f"{name}:" for name in THREADS)],
                      [[name, *(kilobytes(depths[thread][0]) if thread in depths else "" for thread in THREADS)]
                       for name, depths in rows])


def above_first_frame(rows):
    """Bytes that every stack holds before its thread begins."""
    return max(whole - own for _, depths in rows for own, whole in depths.values())


def section(report):
    """Markdown from the heading on. `report`: as tools/measure-size gathers it."""
    data, bss = report["code"][0][1][1:]
    missing = f" Not run, for want of the data: {', '.join(report['missing'])}." if report["missing"] else ""
    return f"""{HEADING}

Written by `tools/measure-size --record` on {report['date']}, commit {report['commit']}, {report['machine']},
release build; kB are 1000 bytes.

**Code.** `size` of the daemon, and of its parts as they were compiled: what several parts have, templates above all, is
kept once in the daemon. Its share of libraries of the system is not in it.

{code_table(report['code'])}

**Static storage.** {kilobytes(data + bss)} kB in the daemon (data and zeroed), most of it tables that never change after
start-up. The largest:

{page.table(["object", "bytes:"], [[f"`{name}`", f"{size:,}"] for name, size in report['objects']])}

**Fixed storage.** What is allocated once, before the first sample: object and what its constructor takes from the heap.

{page.table(["part", "kB:"], [[name, kilobytes(size)] for name, size in report['parts']])}

**Stack.** The deepest byte that each thread wrote in a whole run of `swiftletd` at full speed, below the thread's first
frame, in kB. Stacks are painted before a thread begins and looked through when it ends
(`tests/benchmarks/painted_stacks.cpp`, preloaded into the daemon), so this is what was used, no bound for what might
be. Each stack holds another {kilobytes(report['above'])} kB at its top, for the C library and for thread-local variables, most of them
METIS', which CHOLMOD brings along. How large a stack is, the system says, usually 8 MB; only what was touched takes
memory. The simulated vehicle lives in the radio thread; no run has a dongle, so libusb is not in it.{missing}

{stack_table(report['stacks'])}

**Memory.** The most that `swiftletd` held resident over such runs, libraries of the system included; from run to run it
differs by up to 2 MiB. Outputs, which `--output` asks for, come on top.

{page.table(["input", "MiB:"], [[name, f"{size / MIB:.1f}"] for name, size in report['peaks']])}

What `swiftlet map` holds for each log, with its picture and without, and how it grows, is in
[speed.md](results/speed.md).
"""


def with_section(document, text):
    """`document` with its section of HEADING replaced by `text`, or that at its end if there is none."""
    found = re.search(rf"^{HEADING}\n.*?(?=^## |\Z)", document, re.MULTILINE | re.DOTALL)
    if found is None:
        return document.rstrip("\n") + "\n\n" + text
    rest = document[found.end():]
    return document[:found.start()] + text + ("\n" + rest if rest else "")

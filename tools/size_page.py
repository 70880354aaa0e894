# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Parses the output of `size`, `nm` and the programs of tools/measure-size, and formats the section of
docs/real_time_evidence.md that it writes."""

import re

import benchmark_page as page

HEADING = "## Code size, static storage, stack, memory"
MIB = 1024.0 * 1024.0
THREADS = ["radio", "frontend", "backend", "publisher", "recorder"]
LARGEST = 5


def sizes(text):
    """text, data and bss in bytes, of the last line of the output of `size -t`. Raises ValueError."""
    return [int(number) for number in text.strip().splitlines()[-1].split()[:3]]


def static_objects(text):
    """Name and bytes of the largest objects with an address of their own outside the code, from the output of
    `nm -C -S --size-sort`; largest first."""
    found = re.findall(r"^\w+ (\w+) [bBdD] (.+)$", text, re.MULTILINE)
    return [(re.sub(r"\(anonymous namespace\)::|\([^()]*\)( const)?", "", name), int(size, 16))
            for size, name in reversed(found)][:LARGEST]


def fixed_parts(text):
    """Name and total bytes of each part, from the output of tests/benchmarks/fixed_storage.cpp."""
    rows = (line.split("\t") for line in text.splitlines())
    return [(name, int(own) + int(heap)) for name, own, heap in rows]


def stack_depths(text):
    """Bytes below the first frame, and below the top of the stack, by name of the thread, from the output of
    tests/benchmarks/painted_stacks.cpp; the deepest of those of one name."""
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
    """`rows`: name of an input, depths of its threads as stack_depths() returns them."""
    return page.table(["input", *(f"{name}:" for name in THREADS)],
                      [[name, *(kilobytes(depths[thread][0]) if thread in depths else "" for thread in THREADS)]
                       for name, depths in rows])


def above_first_frame(rows):
    """Bytes that every stack holds before its thread begins."""
    return max(whole - own for _, depths in rows for own, whole in depths.values())


def section(report):
    """Markdown from the heading on. `report`: as tools/measure-size collects it."""
    data, bss = report["code"][0][1][1:]
    missing = f" Not run, for lack of data: {', '.join(report['missing'])}." if report["missing"] else ""
    return f"""{HEADING}

Written by `tools/measure-size --record` on {report['date']}, commit {report['commit']}, {report['machine']},
release build; kB are 1000 bytes.

**Code.** `size` of the daemon, and of its parts as compiled. What several parts contain, mostly templates, is in the
daemon once. System libraries are not included.

{code_table(report['code'])}

**Static storage.** {kilobytes(data + bss)} kB in the daemon (data and zeroed), mostly tables that never change after start-up. The
largest:

{page.table(["object", "bytes:"], [[f"`{name}`", f"{size:,}"] for name, size in report['objects']])}

**Fixed storage.** Allocated once, before the first sample: the object and what its constructor takes from the heap.

{page.table(["part", "kB:"], [[name, kilobytes(size)] for name, size in report['parts']])}

**Stack.** The deepest byte that each thread wrote in a whole run of `swiftletd` at full speed, below the first frame of
the thread, in kB. A stack is painted before its thread begins and searched when it ends
(`tests/benchmarks/painted_stacks.cpp`, preloaded into the daemon), so this is what was used, not a bound. Each stack
holds another {kilobytes(report['above'])} kB at its top, for the C library and for thread-local variables, most of them those of METIS, which
comes with CHOLMOD. The system sets the size of a stack, usually 8 MB; only touched pages take memory. The simulated
vehicle runs in the radio thread. No run has a dongle, so libusb is not included.{missing}

{stack_table(report['stacks'])}

**Memory.** The maximum resident memory of `swiftletd` over such runs, including system libraries; it differs by up to
2 MiB from run to run. Outputs come on top; these runs write none (`--no-output`).

{page.table(["input", "MiB:"], [[name, f"{size / MIB:.1f}"] for name, size in report['peaks']])}

The memory of `swiftlet map` for each log, with its picture and without, and its growth, are in
[speed.md](results/speed.md).
"""


def with_section(document, text):
    """`document` with its section of HEADING replaced by `text`, or with `text` at its end if there is none."""
    found = re.search(rf"^{HEADING}\n.*?(?=^## |\Z)", document, re.MULTILINE | re.DOTALL)
    if found is None:
        return document.rstrip("\n") + "\n\n" + text
    rest = document[found.end():]
    return document[:found.start()] + text + ("\n" + rest if rest else "")

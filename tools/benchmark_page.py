# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Shared by the tools/benchmark-*: the release build, programs of Google Benchmark, and the page of results with date,
commit and machine."""

import datetime
import json
import math
import os
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build/release"
RESULTS = ROOT / "docs/results"
EASIER_SENSOR = """Worlds drawn by hand (office, maze and so on) have an easier sensor than
[buildings](../simulated_buildings.md#errors): the noise of their ranges is Gaussian, without wild readings."""


def run(*command):
    """The command's stdout. Raises OSError or subprocess.CalledProcessError."""
    return subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout


def build(*targets):
    """Raises as run() does."""
    run("cmake", "--preset", "release")
    run("cmake", "--build", "--preset", "release", "--target", *targets)


def google_benchmarks(program):
    """The rows that a program of tests/benchmarks reports by Google Benchmark. Raises as run() does."""
    return json.loads(run(str(BUILD / "tests/benchmarks" / program), "--benchmark_format=json"))["benchmarks"]


def circumstances():
    """Date, commit and machine. Call before the build: the commit is the one that is built, and the load is not yet
    that of the build. Raises as run() does."""
    return {"date": datetime.date.today().isoformat(), "commit": _commit(), "machine": _machine()}


def _commit():
    changed = run("git", "status", "--porcelain", "--untracked-files=no", "--", ":!docs/results")
    return run("git", "rev-parse", "--short", "HEAD").strip() + (" with changes" if changed else "")


def _machine():
    names = re.findall(r"^model name\s*:\s*(.+)$", Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.MULTILINE)
    name = names[0] if names else "unknown processor"
    undisturbed = os.sched_getscheduler(0) in (os.SCHED_FIFO, os.SCHED_RR)
    return (f"{os.cpu_count()} cores, {name}, load average {os.getloadavg()[0]:.1f}"
            + (", measured at real-time priority" if undisturbed else ""))


def head(title, tool, report):
    """The beginning of a page."""
    return (f"# {title}\n\nWritten by `tools/{tool} --record` on {report['date']}, commit {report['commit']}.\n"
            f"Machine: {report['machine']}.\n")


def left_out(missing):
    """Behind the head. `missing`: names of data; nothing without any."""
    return f"\nLeft out, for lack of data: {'; '.join(missing)}.\n" if missing else ""


def table(columns, rows):
    """Markdown. `columns`: headings, a trailing ':' aligns right. `rows`: texts."""
    marks = ["---:" if column.endswith(":") else "---" for column in columns]
    lines = [[column.rstrip(":") for column in columns], *rows]
    texts = ["| " + " | ".join(line) + " |" for line in lines]
    return "\n".join([texts[0], "|" + "|".join(marks) + "|", *texts[1:]])


def quantile(values, share):
    """The greatest of the lowest share of them, as `swiftlet eval` has it. `values`: at least one."""
    return sorted(values)[max(math.ceil(share * len(values)), 1) - 1]


def record(name, text, folder=RESULTS):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(text, encoding="utf-8")

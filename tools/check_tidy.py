#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""clang-tidy on the sources that changed since HEAD left the default branch of "origin", or in the last commit where HEAD
is on that branch. A changed header stands for the source of its name. Of many, the MOST with the most changed lines: two
minutes on two cores. Exit code 1 if clang-tidy reports anything.

Usage: check_tidy.py [--all | FILE...]     --all: every source, which takes hours
"""

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MOST = 10


def git(*arguments):
    """The lines that git prints; none where it fails."""
    run = subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True, text=True, check=False)
    return run.stdout.split("\n")[:-1] if run.returncode == 0 else []


def base_of_change():
    """The commit to compare with, or None in a clone of one commit."""
    head = git("rev-parse", "HEAD")
    shared = git("merge-base", "HEAD", "origin/HEAD")
    return (shared if shared and shared != head else git("rev-parse", "--verify", "--quiet", "HEAD~1") or [None])[0]


def changed_lines(numstat, sources):
    """How many lines changed of each of `sources` that did change, by the lines of git diff --numstat."""
    lines = {}
    for added, deleted, path in (line.split("\t") for line in numstat):
        source = str(Path(path).with_suffix(".cpp"))
        if path.endswith((".hpp", ".cpp")) and source in sources:
            lines[source] = lines.get(source, 0) + int(added) + int(deleted)
    return lines


def most_changed(lines, most=MOST):
    """The same ones wherever it runs: they do not depend on HEAD."""
    return sorted(lines, key=lambda source: (-lines[source], source))[:most]


def tidy(path):
    run = subprocess.run(["clang-tidy", "-p", "build/tidy", "--quiet", path], cwd=ROOT, capture_output=True, text=True,
                         check=False)
    print(f"{path}: {'silent' if run.returncode == 0 else 'FAILS'}", flush=True)
    return "" if run.returncode == 0 else run.stdout + run.stderr


def main():
    if sys.argv[1:] in (["-h"], ["--help"]):
        print(__doc__)
        return 0
    sources = git("ls-files", "*.cpp")
    paths = sources if sys.argv[1:] == ["--all"] else sys.argv[1:]
    if not paths:
        base = base_of_change()
        changed = changed_lines(git("diff", "--numstat", "--no-renames", base) if base else [], set(sources))
        paths = most_changed(changed)
        print(f"clang-tidy: {len(changed)} sources changed since {base}; {len(paths)} are looked at")
    subprocess.run(["cmake", "--preset", "tidy"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", "--preset", "tidy"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = [text for text in pool.map(tidy, paths) if text]
    print(*faults, sep="\n", end="")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

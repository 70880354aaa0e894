#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""clang-tidy on the sources that changed since the default branch of "origin", or in the last commit where HEAD is that
branch; a changed header stands for the source of its name. At most MOST of them, and FEW that did not change: HEAD's
hash picks, so that what a run leaves out a later one takes. Exit code 1 if clang-tidy has something to say.

Usage: check_tidy.py [--all | FILE...]     --all: every source, which takes an hour
"""

import hashlib
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MOST = 14
FEW = 2


def git(*arguments):
    """The lines that git prints; none where it fails."""
    run = subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True, text=True, check=False)
    return run.stdout.split("\n")[:-1] if run.returncode == 0 else []


def base_of_change():
    """The commit to compare with, or None in a clone of one commit."""
    head = git("rev-parse", "HEAD")
    shared = git("merge-base", "HEAD", "origin/HEAD")
    return (shared if shared and shared != head else git("rev-parse", "--verify", "--quiet", "HEAD~1") or [None])[0]


def sources_of(paths, sources):
    """Of `sources`, those that stand for the changed `paths`."""
    changed = {str(Path(path).with_suffix("")) for path in paths if path.endswith((".hpp", ".cpp"))}
    return [source for source in sources if source[:-len(".cpp")] in changed]


def choose(sources, changed, seed, most=MOST, few=FEW):
    """`most` of `changed` and `few` others, as `seed` picks them."""
    picked = sorted(sources, key=lambda path: hashlib.sha1(f"{seed} {path}".encode()).digest())
    others = [path for path in picked if path not in changed]
    return [path for path in picked if path in changed][:most] + others[:few]


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
        changed = sources_of(git("diff", "--name-only", base) if base else [], sources)
        paths = choose(sources, changed, git("rev-parse", "HEAD"))
        print(f"clang-tidy: {len(changed)} sources changed since {base}; {len(paths)} are looked at")
    subprocess.run(["cmake", "--preset", "tidy"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", "--preset", "tidy"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = [text for text in pool.map(tidy, paths) if text]
    print(*faults, sep="\n", end="")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Holds the sources to the plan in docs/architecture.md: who may include whom, which libraries appear in one
source file only, what core must not know, and the two licence lines. Prints one line a fault; exit code 1 if
there is any.

Usage: check_includes.py [REPOSITORY]
"""

import re
import sys
from pathlib import Path

SENSING = ["core/base", "core/geometry", "core/sensing"]
CORE = SENSING + ["core/frontend", "core/backend", "core/mapping", "core/evaluation", "core/calibration"]
ALLOWED = {  # folder: folders it may include from, besides itself; the longest matching folder counts
    "core/base": [],
    "core/geometry": ["core/base"],
    "core/sensing": ["core/base", "core/geometry"],
    "core/frontend": SENSING,
    "core/backend": SENSING,
    "core/mapping": SENSING + ["core/frontend", "core/backend"],
    "core/evaluation": SENSING,
    "core/calibration": SENSING + ["core/frontend", "core/backend"],
    "firmware_link": SENSING,
    "daemon": CORE + ["firmware_link", "proto"],
    "tools": CORE + ["firmware_link", "proto", "daemon"],
    "tests": CORE + ["firmware_link", "proto", "daemon", "tools"],
}
ONE_FILE_ONLY = {
    "libusb": re.compile(r"^libusb(-1\.0/libusb)?\.h$"),
    "CHOLMOD": re.compile(r"(^|/)cholmod\.h$"),
    "LCM": re.compile(r"^lcm/lcm"),
    "libsystemd": re.compile(r"^systemd/"),
}
NOT_IN_CORE = {"thread", "mutex", "shared_mutex", "condition_variable", "future", "fstream", "iostream", "filesystem"}
ASKS_FOR_THE_TIME = re.compile(r"\bnow\s*\(\s*\)")
GENERATED = re.compile(r"^swiftlet/(\w+)\.hpp$")  # by lcm-gen, from proto/
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SPDX = ("SPDX-License-Identifier: MIT", "SPDX-FileCopyrightText: ")


def folder_of(path):
    matching = [f for f in ALLOWED if path == f or path.startswith(f + "/")]
    return max(matching, key=len, default=None)


def check_include(path, number, quoted, included, root):
    included = GENERATED.sub(r"proto/\1.lcm", included)
    folder, other = folder_of(path), folder_of(included)
    if quoted and not (root / included).is_file():
        yield f'{path}:{number}: "{included}" is no path from the top of the repository'
    elif other and other != folder and other not in ALLOWED[folder]:
        yield f"{path}:{number}: {folder} must not include {included}"
    if path.startswith("core/") and included in NOT_IN_CORE:
        yield f"{path}:{number}: core has no threads and no files: <{included}>"


def check_source(path, text, root, users):
    lines = text.splitlines()
    if len(lines) < 2 or not all(mark in line for mark, line in zip(SPDX, lines)):
        yield f"{path}:1: does not begin with the two SPDX lines"
    for number, line in enumerate(lines, 1):
        code = line.split("//")[0]
        if path.startswith("core/") and ASKS_FOR_THE_TIME.search(code):
            yield f"{path}:{number}: core cannot ask for the time, it is told"
        include = INCLUDE.match(line)
        if not include:
            continue
        yield from check_include(path, number, include[1] == '"', include[2], root)
        for library, pattern in ONE_FILE_ONLY.items():
            if pattern.search(include[2]) and not path.startswith("tests/"):
                users[library].add(path)


def check_script(path, text):
    lines = text.splitlines()[1:3]
    if len(lines) < 2 or not all(mark in line for mark, line in zip(SPDX, lines)):
        yield f"{path}:2: the two SPDX lines do not follow the first"


def faults_in(root):
    users = {library: set() for library in ONE_FILE_ONLY}
    for top in ("core", "firmware_link", "daemon", "tools", "tests"):
        for file in sorted((root / top).rglob("*")):
            path = file.relative_to(root).as_posix()
            if file.suffix in (".hpp", ".cpp", ".h", ".c"):
                yield from check_source(path, file.read_text(encoding="utf-8"), root, users)
            elif file.is_file() and file.read_bytes()[:2] == b"#!":
                yield from check_script(path, file.read_text(encoding="utf-8"))
    for library, paths in users.items():
        if len(paths) > 1:
            yield f"{library} belongs in one source file, not in {', '.join(sorted(paths))}"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent)
    faults = list(faults_in(root))
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Compares the sources with the plan in docs/architecture.md: who may include whom, which libraries appear in one
source file only, what core must not use, that a name in the namespace is one type, that no id is made of another kind
of id, and the two licence lines. Prints a line a fault; exit code 1 if there is any.

Usage: check_includes.py [REPOSITORY]
"""

import re
import sys
from pathlib import Path

SENSING = ["core/base", "core/geometry", "core/sensing"]
BACKEND = ["core/backend/config", "core/backend/store", "core/backend/pose_graph", "core/backend/loop_closing",
           "core/backend/refinement", "core/backend/pruning", "core/backend/confidence"]
SLAM = SENSING + ["core/frontend", "core/backend"]
CORE = SLAM + BACKEND + ["core/mapping", "core/mapping/picture", "core/evaluation", "core/calibration", "core/run"]
LINK = ["firmware_link/crtp", "firmware_link/link"]
SESSION = LINK + ["firmware_link/session"]
SAMPLE = SESSION + ["firmware_link/sample", "firmware_link/file"]
FIRMWARE_LINK = SAMPLE + ["firmware_link/sharing", "firmware_link/capture", "firmware_link/laser_log",
                          "firmware_link/sample_table", "firmware_link/simulation", "firmware_link/input"]
STAGES = ["daemon/config", "daemon/system", "daemon/workers"]
DAEMON = STAGES + ["daemon/manual", "daemon/publish", "daemon/view", "daemon/recording", "daemon/outputs",
                   "daemon/commands", "daemon"]
ALLOWED = {  # folder: folders it may include from, besides itself; the longest matching folder counts
    "core/base": [],
    "core/geometry": ["core/base"],
    "core/sensing": ["core/base", "core/geometry"],
    "core/frontend": SENSING,
    "core/backend": SENSING + BACKEND,
    "core/backend/config": SENSING,
    "core/backend/store": SENSING,
    "core/backend/pose_graph": SENSING + BACKEND[:2],
    "core/backend/loop_closing": SENSING + BACKEND[:3],
    "core/backend/confidence": SENSING + BACKEND[:4],
    "core/backend/refinement": SENSING + BACKEND[:3],
    "core/backend/pruning": SENSING + BACKEND[:3],
    "core/mapping": SLAM + BACKEND,
    "core/mapping/picture": SLAM + BACKEND + ["core/mapping"],
    "core/evaluation": SENSING,
    "core/calibration": SLAM + BACKEND,
    "core/run": SLAM + BACKEND,
    "firmware_link/crtp": SENSING,
    "firmware_link/link": SENSING + ["firmware_link/crtp"],
    "firmware_link/session": SENSING + LINK,
    "firmware_link/file": SENSING,
    "firmware_link/sample": SENSING + SESSION,
    "firmware_link/sharing": SENSING + SESSION,
    "firmware_link/capture": SENSING + SESSION + ["firmware_link/file"],
    "firmware_link/laser_log": SENSING + ["firmware_link/file", "firmware_link/sample"],
    "firmware_link/sample_table": SENSING + SAMPLE,
    "firmware_link/simulation": SENSING + LINK,
    "firmware_link/input": SENSING + FIRMWARE_LINK,
    "daemon/system": ["core/base"],
    "daemon/manual": [],
    "daemon/config": CORE + ["daemon/system"],
    "daemon/workers": CORE + FIRMWARE_LINK + ["daemon/config", "daemon/system"],
    "daemon/publish": CORE + FIRMWARE_LINK + STAGES + ["proto"],
    "daemon/view": CORE + FIRMWARE_LINK + STAGES + ["daemon/publish", "proto"],
    "daemon/recording": CORE + FIRMWARE_LINK + STAGES,
    "daemon/outputs": CORE + FIRMWARE_LINK + STAGES,
    "daemon/commands": CORE + FIRMWARE_LINK + STAGES + ["daemon/publish", "daemon/outputs", "proto"],
    "daemon": CORE + FIRMWARE_LINK + DAEMON,
    "tools": CORE + FIRMWARE_LINK + DAEMON + ["proto"],
    "tools/python": CORE + FIRMWARE_LINK + DAEMON + ["proto", "tools"],
    "tests": CORE + FIRMWARE_LINK + DAEMON + ["proto", "tools", "tools/python"],
}
ONE_FILE_ONLY = {
    "libusb": re.compile(r"^libusb(-1\.0/libusb)?\.h$"),
    "CHOLMOD": re.compile(r"(^|/)cholmod\.h$"),
    "LCM": re.compile(r"^lcm/lcm"),
    "libsystemd": re.compile(r"^systemd/"),
    "Boost.Beast": re.compile(r"^boost/(beast|asio)"),
    "pybind11": re.compile(r"^pybind11/"),
}
NOT_IN_CORE = {"thread", "mutex", "shared_mutex", "condition_variable", "future", "fstream", "iostream", "filesystem"}
ASKS_FOR_THE_TIME = re.compile(r"\bnow\s*\(\s*\)")
GENERATED = re.compile(r"^swiftlet/(\w+)\.hpp$")  # by lcm-gen, from proto/
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
TYPE = re.compile(r"(?:struct|class|enum class|enum|union) (\w+)(?: final)?(?: : [^;{]+)? \{")  # in the namespace itself
IDS = "KeyframeId|LandmarkId|ScanId|TraversalId|ClosureId|FactorId|PoseIndex"
CASTS_AN_ID = re.compile(rf"static_cast<(?:{IDS})>|\b(?:{IDS})\s*[({{]\s*index_of\(|\bmake_id<\w+>\(\s*index_of\(")
MAY_CAST_IDS = ("core/base/ids.hpp", "core/backend/store/traversal.hpp")
SPDX = ("SPDX-License-Identifier: MIT", "SPDX-FileCopyrightText: ")


def folder_of(path):
    matching = [f for f in ALLOWED if path == f or path.startswith(f + "/")]
    return max(matching, key=len, default=None)


def check_include(path, number, quoted, included, root):
    included = GENERATED.sub(r"proto/\1.lcm", included)
    folder, other = folder_of(path), folder_of(included)
    if quoted and not (root / included).is_file():
        yield f'{path}:{number}: "{included}" is no path from the top of the repository'
    elif other and other != folder and other not in ALLOWED.get(folder, []):
        yield f"{path}:{number}: {folder} must not include {included}"
    if path.startswith("core/") and included in NOT_IN_CORE:
        yield f"{path}:{number}: core has no threads and no files: <{included}>"


def check_source(path, text, root, users):
    lines = text.splitlines()
    if folder_of(path) is None:
        yield f"{path}: its folder has no place in the plan"
    if len(lines) < 2 or not all(mark in line for mark, line in zip(SPDX, lines)):
        yield f"{path}:1: does not begin with the two SPDX lines"
    for number, line in enumerate(lines, 1):
        code = line.split("//")[0]
        if path.startswith("core/") and ASKS_FOR_THE_TIME.search(code):
            yield f"{path}:{number}: core must not read a clock: time is a parameter"
        if CASTS_AN_ID.search(code) and not path.startswith("tests/") and path not in MAY_CAST_IDS:
            yield f"{path}:{number}: an id of one kind is not made of another"
        include = INCLUDE.match(line)
        if not include:
            continue
        yield from check_include(path, number, include[1] == '"', include[2], root)
        for library, pattern in ONE_FILE_ONLY.items():
            if pattern.search(include[2]) and not path.startswith("tests/"):
                users[library].add(path)


def types_defined(text):
    """Names of the types that a source defines in the namespace, neither inside another type nor for itself alone."""
    is_for_itself = False
    for line in text.splitlines():
        if line.startswith("namespace {"):
            is_for_itself = True
        elif line == "}  // namespace":
            is_for_itself = False
        elif not is_for_itself and (found := TYPE.match(line)):
            yield found[1]


def check_script(path, text):
    lines = text.splitlines()[1:3]
    if len(lines) < 2 or not all(mark in line for mark, line in zip(SPDX, lines)):
        yield f"{path}:2: the two SPDX lines do not follow the first"


def faults_in(root):
    users = {library: set() for library in ONE_FILE_ONLY}
    defined_in = {}
    for top in ("core", "firmware_link", "daemon", "tools", "tests"):
        for file in sorted((root / top).rglob("*")):
            path = file.relative_to(root).as_posix()
            if file.suffix in (".hpp", ".cpp", ".h", ".c"):
                text = file.read_text(encoding="utf-8")
                yield from check_source(path, text, root, users)
                if top != "tests":
                    for name in types_defined(text):
                        defined_in.setdefault(name, []).append(path)
            elif file.is_file() and file.read_bytes()[:2] == b"#!":
                yield from check_script(path, file.read_text(encoding="utf-8"))
    for name, paths in defined_in.items():
        if len(paths) > 1:
            yield f"{name} is defined {len(paths)} times: in {', '.join(paths)}"
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

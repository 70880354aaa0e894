#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The types of the package, by mypy: that they are right, complete, and what the C++ part has. Exit code 77: mypy is
not installed. types_test.py"""

import importlib.util
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import swiftlet

USE = """
import numpy as np
import numpy.typing as npt
import swiftlet

run = swiftlet.map("flight.pcap", settings={"map.resolution_m": 0.1}, on_progress=print)
path: npt.NDArray[np.float64] = run.trajectory
cells: npt.NDArray[np.int8] = run.grid.occupancy_percent
for message in swiftlet.listen(timeout=1.0):
    if isinstance(message, swiftlet.Pose):
        x_m: float = message.x_m
swiftlet.map(3)
"""


def mypy(*arguments, folder):
    return subprocess.run([sys.executable, "-m", *arguments], capture_output=True, text=True, check=False, cwd=folder,
                          env={**os.environ, "MYPYPATH": str(Path(swiftlet.__file__).parents[1])})


def main():
    if importlib.util.find_spec("mypy") is None:
        print("skipped: mypy is not installed")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        whole = mypy("mypy", "--strict", "-p", "swiftlet", folder=folder)
        assert whole.returncode == 0, whole.stdout + whole.stderr
        Path(folder, "use.py").write_text(USE, encoding="utf-8")
        use = mypy("mypy", "--strict", "use.py", folder=folder)
        faults = [line for line in use.stdout.splitlines() if ": error: " in line]
        assert len(faults) == 1 and 'to "map" has incompatible type "int"' in faults[0], use.stdout
        Path(folder, "allowed").write_text(r"swiftlet\._native\.Listener", encoding="utf-8")  # pybind11's metaclass
        native = mypy("mypy.stubtest", "--ignore-missing-stub", "--allowlist", "allowed", "swiftlet._native",
                      folder=folder)
        assert native.returncode == 0, native.stdout + native.stderr
    return 0


if __name__ == "__main__":
    sys.exit(main())

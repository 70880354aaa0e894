#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/log_sharpness.py counts cells of all readings along a trajectory."""

import gzip
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import log_sharpness  # noqa: E402


class LogSharpness(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        with gzip.open(self.folder / "log.gz", "wt") as file:  # ahead a wall, to the right none, to the left too near
            for i in range(3):
                ranges = ["81.9", *["0.05"] * 89, "2.03", *["7.0"] * 89, "0.02"]
                file.write(f"FLASER 181 {' '.join(ranges)} 0 0 0 0 0 0 {i}.0 host {i}.0\n")

    def cells(self, *places):
        trajectory = self.folder / "poses.tum"
        trajectory.write_text("# stamp x y z qx qy qz qw\n" + "".join(
            f"{stamp:.6f} {x_m} 0.01 0 0 0 0 1\n" for stamp, x_m in places))
        return log_sharpness.evaluate(trajectory, self.folder / "log.gz")

    def test_a_wall_drawn_once_takes_fewer_cells_than_drawn_twice(self):
        self.assertEqual(self.cells((0, 0.0), (1, 0.0), (2, 0.0))["cells_10_cm"], 1)
        self.assertEqual(self.cells((0, 0.0), (1, 0.5), (2, 0.5))["cells_10_cm"], 2)

    def test_only_returns_of_scans_with_a_pose_are_drawn(self):
        figures = self.cells((1, 0.0), (9, 0.0))
        self.assertEqual((figures["drawn"], figures["scans"], figures["returns"]), (1, 3, 1))


if __name__ == "__main__":
    unittest.main()

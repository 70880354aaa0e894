#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/measure-odometry-noise finds the random walk that a path was reckoned with."""

import importlib.util
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(__file__).resolve().parents[2] / "tools/measure-odometry-noise"
STEPS, STEP_S, STEP_RAD = 40000, 0.1, 0.1
LEG = 100  # steps
LEGS_M = [0.05, 0.0, 0.02, 0.0]  # a step of each in turn: on, round on the spot, on slowly, standing still
AFTER_METRE_DEG, AFTER_RADIAN_DEG, ALONG_M = 1.0, 3.0, 0.02


def write_path(file, stamps, x_m, y_m, yaw_rad):
    import numpy as np
    rows = np.column_stack([stamps, x_m, y_m, 0 * x_m, 0 * x_m, 0 * x_m, np.sin(yaw_rad / 2), np.cos(yaw_rad / 2)])
    np.savetxt(file, rows, fmt="%.9f")


@unittest.skipUnless(importlib.util.find_spec("numpy"), "needs numpy")
class MeasureOdometryNoise(unittest.TestCase):
    def measured(self, folder):
        return subprocess.run([sys.executable, TOOL, folder], capture_output=True, text=True, check=False)

    def test_what_a_path_was_reckoned_with_is_found(self):
        import numpy as np
        random = np.random.default_rng(1)
        leg = np.arange(STEPS) // LEG % len(LEGS_M)
        forward_m = np.array(LEGS_M)[leg]
        turn_rad = np.where(leg == 1, STEP_RAD, 0.0)
        sigma_rad = np.radians(AFTER_METRE_DEG * forward_m**0.5 + AFTER_RADIAN_DEG * turn_rad**0.5)
        reckoned_m = forward_m + random.normal(0.0, ALONG_M * forward_m**0.5)
        stamps = 1e9 + STEP_S * np.arange(STEPS)
        with tempfile.TemporaryDirectory() as name:
            for file, steps_m, turns_rad in (("trajectory.tum", forward_m, turn_rad),
                                             ("odometry.tum", reckoned_m, turn_rad + random.normal(0.0, sigma_rad))):
                yaw = np.cumsum(turns_rad)
                write_path(Path(name, file), stamps, np.cumsum(steps_m * np.cos(yaw)), np.cumsum(steps_m * np.sin(yaw)), yaw)
            text = self.measured(name).stdout
        along = {float(way): float(along) for way, along in re.findall(r"over ([\d.]+) m: along ([\d.]+) m", text)}
        self.assertEqual(sorted(along), [0.5, 1.0, 2.0, 4.0])
        for figure in along.values():
            self.assertAlmostEqual(figure, ALONG_M, delta=0.2 * ALONG_M)
        for figure in re.findall(r"yaw ([\d.]+) deg, after a metre", text):
            self.assertAlmostEqual(float(figure), AFTER_METRE_DEG, delta=0.2)
        metre, radian, second = map(float, re.search(r"yaw ([\d.]+) deg after a metre, ([\d.]+) after a radian, ([\d.]+)",
                                                     text).groups())
        self.assertAlmostEqual(metre, AFTER_METRE_DEG, delta=0.2)
        self.assertAlmostEqual(radian, AFTER_RADIAN_DEG, delta=0.3)
        self.assertLess(second, 0.4)

    def test_a_folder_without_a_run_is_one_line(self):
        with tempfile.TemporaryDirectory() as name:
            outcome = self.measured(name)
        self.assertEqual((outcome.returncode, outcome.stderr.count("\n")), (2, 1))


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/wheels_by_relations.py finds the errors that an odometry was given."""

import math
import random
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import wheels_by_relations as wheels  # noqa: E402

SCALE = 0.95
MISSED_RAD_PER_M = 0.05
MISSED_OF_TURN = 0.02


def moved(pose, forward_m, turn_rad):
    x, y, yaw = pose
    return x + forward_m * math.cos(yaw), y + forward_m * math.sin(yaw), yaw + turn_rad


def drive(steps):
    """True and measured poses, one a second."""
    chance = random.Random(1)
    true, measured = [(0.0, 0.0, 0.0)], [(3.0, -2.0, 1.0)]
    for _ in range(steps):
        forward_m, turn_rad = chance.uniform(0.3, 0.5), chance.choice((-0.4, 0.0, 0.0, 0.3))
        measured.append(moved(measured[-1], forward_m, turn_rad))
        true.append(moved(true[-1], SCALE * forward_m,
                          turn_rad * (1.0 + MISSED_OF_TURN) + MISSED_RAD_PER_M * forward_m))
    return true, measured


class WheelsByRelations(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.relations, self.odometry = (Path(self.folder.name, name) for name in ("relations", "odometry"))

    def write(self, relations, true, measured, noise_m=0.0):
        chance = random.Random(2)
        lines = []
        for i, j in relations:
            x, y, yaw = wheels.between(true[i], true[j])
            x, y = (at_m + chance.gauss(0, noise_m) for at_m in (x, y))
            lines.append(f"{100 + i} {100 + j} {x} {y} 0 0 0 {yaw}\n")
        self.relations.write_text("# from to x y z roll pitch yaw\n" + "".join(lines))
        self.odometry.write_text("".join(
            f"{100 + i}.000001 {x} {y} 0 0 0 {math.sin(yaw / 2)} {math.cos(yaw / 2)}\n"
            for i, (x, y, yaw) in enumerate(measured)))

    def test_finds_scale_and_missed_yaw_whichever_way_a_relation_goes(self):
        self.write([(i, i + 1) if i % 2 else (i + 1, i) for i in range(300)], *drive(300))
        found = wheels.estimate(self.relations, self.odometry)
        self.assertEqual(found["relations"], 300)
        for name, true in (("scale", SCALE), ("missed_yaw_per_metre_rad", MISSED_RAD_PER_M)):
            value, sigma = found[name]
            self.assertAlmostEqual(value, true, 3)
            self.assertLess(sigma, 1e-3)

    def test_noise_of_relations_shows_in_the_deviation_and_draws_the_scale_nowhere(self):
        true, measured = drive(2000)
        self.write([(i, i + 1) for i in range(2000)], true, measured, noise_m=0.05)
        value, sigma = wheels.estimate(self.relations, self.odometry)["scale"]
        self.assertLess(abs(value - SCALE), 3 * sigma)
        self.assertAlmostEqual(sigma, 0.05 / (0.4 * math.sqrt(2000)), delta=0.0003)

    def test_leaves_out_relations_that_span_long_and_those_without_poses(self):
        true, measured = drive(100)
        self.write([(i, i + 1) for i in range(50)] + [(0, 30), (50, 90), (98, 99)], true, measured[:60])
        self.assertEqual(wheels.estimate(self.relations, self.odometry)["relations"], 50)

    def test_too_few_say_nothing(self):
        self.write([], *drive(10))
        self.assertEqual(wheels.estimate(self.relations, self.odometry),
                         {"relations": 0, "scale": None, "missed_yaw_per_metre_rad": None})


if __name__ == "__main__":
    unittest.main()

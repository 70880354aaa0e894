#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/doubt_runs.py puts what was published beside the truth."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import doubt_runs as runs  # noqa: E402

# East in truth, north in frame map; the third and fourth pose are published 4 m off. One stamp has no truth.
PRETENDS = """#!/bin/sh
if [ "$1" = map ]; then
  echo '{}' > "$4/report.json"
  for i in 0 1 2 3 4; do echo "10$i $i 5 0 0 0 0 1"; done > "$4/ground_truth.tum"
  printf 'resolution: 0.5\\norigin: [-1.0, 2.0, 0]\\n' > "$4/map.yaml"
  printf 'P5\\n2 2\\n255\\n\\376\\376\\315\\000' > "$4/map.pgm"
else
  echo '{"poses": [[99, 0, 9, 0, 1, 1, "tracking"], [100, 0, 0, 1.57, 0.5, 1, "tracking"],
    [101, 0, 1, 1.57, 1, 1, "tracking"], [102, 4, 2, 1.57, 2, 1, "lost"], [103, 4, 3, 1.57, 2, 1, "lost"],
    [104, 0, 4, 1.57, 1, 1, "tracking"]]}'
fi
"""


class DoubtRuns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            swiftlet = Path(folder, "swiftlet")
            swiftlet.write_text(PRETENDS, encoding="utf-8")
            swiftlet.chmod(0o700)
            cls.flight = runs.flight(swiftlet, "sim://office", 2, folder)

    def test_poses_lie_on_the_truth_by_those_before_the_fault(self):
        self.assertEqual(self.flight.time_s, [0, 1, 2, 3, 4])
        self.assertEqual([round(error, 6) for error in self.flight.errors_m()], [0, 0, 4, 4, 0])

    def test_walls_lie_where_the_poses_do(self):
        [wall] = self.flight.walls  # at (-0.25, 2.25) in frame map
        self.assertAlmostEqual(wall, complex(2.25, 5.25))

    def test_the_radius_is_of_the_worse_direction_from_the_start(self):
        self.assertAlmostEqual(self.flight.radius_95_m[0], 1.224)

    def test_states_are_stretches(self):
        self.assertEqual(list(self.flight.stretches()), [("tracking", 0, 2), ("lost", 2, 4), ("tracking", 4, 5)])

    def test_it_found_back_where_the_error_falls(self):
        self.assertEqual(self.flight.found_back(), 4)
        self.assertEqual(self.flight.index_at(3.5), 4)


if __name__ == "__main__":
    unittest.main()

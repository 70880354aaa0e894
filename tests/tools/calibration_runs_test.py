#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/calibration_runs.py calibrates, and maps without the file, with it, by default, and at an age."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import accuracy_runs  # noqa: E402
import mapped_runs  # noqa: E402
import calibration_runs as runs  # noqa: E402

# Stands in for swiftlet and for calibration_flights: writes down how it was called, and what the real ones write.
PRETENDS = """#!/bin/sh
echo "$@" >> "$0.calls"
if [ "$1" = map ]; then
  while [ "$1" != -o ]; do
    shift
  done
  mkdir "$2"
  for name in trajectory odometry live ground_truth; do echo "5.0 1.0 2.0 0 0 0 0 1" > "$2/$name.tum"; done
  echo '{}' > "$2/report.json"
elif [ "$1" = eval ]; then
  echo "{\\"references\\": [{\\"of\\": \\"$(basename "$2")\\", \\"by\\": \\"$(basename "$3")\\"}]}"
elif [ "$1" = calibrate ]; then
  while [ "$1" != -o ]; do
    shift
  done
  echo "# found" > "$2"
  echo '{"findings": []}'
elif [ "$1" = 7 ]; then
  echo "no flight of seed 7" >&2
  exit 2
else
  echo "{\\"seed\\": $1}"
fi
"""


class CalibrationRuns(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.program = self.folder / "program"
        self.program.write_text(PRETENDS)
        self.program.chmod(0o755)

    def calls(self):
        return Path(f"{self.program}.calls").read_text().replace(str(self.folder), "HERE").splitlines()

    def test_a_flight_is_flown_with_the_usual_sensors_or_with_others(self):
        self.assertEqual(runs.fly(runs.DEFAULT_FLIGHTS[0], self.program), {"seed": 1})
        runs.fly(runs.OTHER_FLIGHTS[1], self.program)
        self.assertEqual(self.calls(), ["1", "12 60 0.1 0.05"])

    def test_a_flight_that_fails_says_why(self):
        with self.assertRaises(subprocess.CalledProcessError) as caught:
            runs.fly(runs.Flight(7), self.program)
        self.assertEqual(caught.exception.stderr, "no flight of seed 7\n")

    def test_a_simulated_flight_is_mapped_without_the_file_with_it_and_by_default_and_judged_by_the_truth(self):
        result = runs.calibrate(runs.OFFICES[1], self.program, self.folder)
        uri = "sim://office?seed=2"
        self.assertEqual([call for call in self.calls() if not call.startswith("eval")],
                         [f"calibrate {uri} --json -o HERE/found.toml",
                          f"map {uri} --no-calibrate -o HERE/without",
                          f"map {uri} --no-calibrate --config HERE/found.toml -o HERE/with",
                          f"map {uri} -o HERE/default"])
        for how in ("without", "with", "default"):
            self.assertEqual(result[how], {"live": {"of": "live.tum", "by": "ground_truth.tum"},
                                           "final": {"of": "trajectory.tum", "by": "ground_truth.tum"}})
        self.assertEqual(result["calibration"], {"findings": []})
        self.assertGreater(result["seconds"], 0.0)
        self.assertIsNone(result["wheels"])

    def test_a_laser_log_keeps_its_beams_and_its_wheels_are_held_against_the_relations(self):
        (self.folder / "log.relations").write_text("5.0 6.0 1 0 0 0 0 0\n")
        log = mapped_runs.Log("a log", "log.clf", "log.relations")
        with mock.patch.object(mapped_runs, "DATASETS", self.folder), \
                mock.patch.object(accuracy_runs, "LASER_LOGS", [log]), \
                mock.patch.object(runs.wheels_by_relations, "estimate", lambda *files: [file.name for file in files]):
            result = runs.calibrate(runs.Input(log, 11), self.program, self.folder)
        self.assertEqual(self.calls()[0], "calibrate HERE/log.clf --beams 11 --json -o HERE/found.toml")
        self.assertEqual(result["without"]["final"]["by"], "log.relations")
        self.assertEqual(result["wheels"], ["log.relations", "odometry.tum"])

    def test_an_age_is_set_by_a_configuration_that_sets_nothing_else(self):
        runs.map_at(0.08, runs.OFFICES[0], self.program, self.folder)
        self.assertEqual(self.calls()[0], "map sim://office?seed=1 --no-calibrate --config HERE/age.toml -o HERE/out")
        self.assertEqual((self.folder / "age.toml").read_text(), "[sensor]\nrange_age_s = 0.08\n")


if __name__ == "__main__":
    unittest.main()

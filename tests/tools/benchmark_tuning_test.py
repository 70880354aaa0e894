#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/benchmark-tuning, with programs that answer at once: what it sets, runs, keeps and repeats."""

import json
import subprocess
import tempfile
import unittest
from pathlib import Path

from pretended_report import REPORT

TOOL = Path(__file__).parents[2] / "tools/benchmark-tuning"
# Stands in for swiftlet. With "steep = 8" its error is that of odometry times two, "calm" changes nothing.
PRETENDS = """#!/bin/sh
echo "$@" >> "{calls}"
if [ "$1" = map ]; then
  while [ "$1" != --config ]; do shift; done
  case "$(cat "$2")" in *"steep = 8"*) error=2.0;; *) error=0.1;; esac
  while [ "$1" != -o ]; do shift; done
  mkdir "$2"
  for file in odometry live ground_truth; do echo 1.0 > "$2/$file.tum"; done
  echo $error > "$2/trajectory.tum"
  echo '{report}' > "$2/report.json"
else
  echo "{{\\"references\\": [{{\\"rmse_m\\": $(cat "$2")}}]}}"
fi
"""
LISTS = """#!/bin/sh
echo '[tuning.part]'
echo 'calm = 2.0  # 0.02 to 200'
echo 'steep = 4  # 1 to 400'
"""


class BenchmarkTuning(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.calls = self.folder / "calls"
        self.program("swiftlet", PRETENDS.format(report=json.dumps(REPORT), calls=self.calls))
        self.program("swiftletd", LISTS)

    def program(self, name, text):
        file = self.folder / name
        file.write_text(text)
        file.chmod(0o755)

    def counted(self, command):
        return sum(line.startswith(command) for line in self.calls.read_text().splitlines())

    def measure(self, *arguments, expected=0):
        programs = [f"--{name}={self.folder / name}" for name in ("swiftlet", "swiftletd")]
        done = subprocess.run([str(TOOL), "-o", str(self.folder / "kept"), "--buildings", "3", "--no-real", *programs,
                               *arguments], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, expected, done.stderr)
        return done

    def test_each_value_is_run_once_over_the_ensemble(self):
        said = self.measure("--jobs", "2").stdout
        self.assertEqual(self.counted("map "), 3 * (1 + 4))
        self.assertEqual(self.measure("--kept").stdout, said)
        self.measure()
        self.assertEqual(self.counted("map "), 3 * (1 + 4))
        self.assertIn("2 constants: 1 islands, 1 that change nothing.", said)
        self.assertIn("| **`part.steep`** | 4 |  | 2 | 0.0 (+0 -0) | 1.000 | 0.100 | 8 | **100.0 (+3 -0)** | 20.000 |",
                      said)
        self.assertIn("| `part.calm` | 2.0 |", said)

    def test_output_that_is_known_is_not_judged_again(self):
        self.measure()
        self.assertEqual(self.counted("eval "), 3 * 2 + 3)  # of the default, and of steep = 8

    def test_only_what_matches_is_changed(self):
        self.assertNotIn("part.steep", self.measure("--only", "*.calm").stdout)
        self.assertIn("no such constant", self.measure("--only", "nothing", expected=2).stderr)

    def test_without_the_default_there_is_nothing_to_report(self):
        self.assertIn("default settings", self.measure("--kept", expected=2).stderr)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/benchmark-robustness, with a program that answers at once: what it runs, keeps, repeats and compares."""

import argparse
import importlib.machinery
import json
import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path
from unittest import mock

from pretended_report import REPORT

TOOL = Path(__file__).parents[2] / "tools/benchmark-robustness"
sys.path.insert(0, str(TOOL.parent))
sys.dont_write_bytecode = True
import mapped_runs  # noqa: E402
import robustness_runs  # noqa: E402

tool = types.ModuleType("benchmark_robustness")
importlib.machinery.SourceFileLoader(tool.__name__, str(TOOL)).exec_module(tool)
# Stands in for swiftlet. Its error is that of the second seed's odometry where the first argument says seed=2.
PRETENDS = """#!/bin/sh
echo "$@" >> "{calls}"
if [ "$1" = map ]; then
  source=$2
  while [ "$1" != -o ]; do shift; done
  mkdir "$2"
  for file in trajectory odometry live ground_truth; do echo "$source" > "$2/$file.tum"; done
  echo picture > "$2/map.png"
  echo '{report}' > "$2/report.json"
else
  case "$(cat "$2") $2" in
    *seed=2*trajectory.tum) error={error};;
    *odometry.tum) error=1.0;;
    *) error=0.1;;
  esac
  echo "{{\\"references\\": [{{\\"rmse_m\\": $error}}]}}"
fi
"""


class BenchmarkRobustness(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.good, self.bad = self.program("good", 0.1), self.program("bad", 2.0)

    def program(self, name, error):
        file = self.folder / name
        file.write_text(PRETENDS.format(error=error, report=json.dumps(REPORT), calls=self.folder / f"{name}.calls"))
        file.chmod(0o755)
        return file

    def runs_of(self, name):
        calls = self.folder / f"{name}.calls"
        return sum(line.startswith("map ") for line in calls.read_text().splitlines()) if calls.exists() else 0

    def measure(self, *arguments, expected=0):
        done = subprocess.run([str(TOOL), "-o", str(self.folder / "kept"), "--buildings", "1:3", *map(str, arguments)],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, expected, done.stderr)
        return done

    def test_each_building_is_flown_once_and_its_picture_kept(self):
        said = self.measure("--swiftlet", self.bad, "--jobs", 2).stdout
        self.assertIn("| final error over 1.02 times that of dead reckoning, % | 33.3", said)
        self.assertIn("seed (kind, ratio): 2 (maze, 2.00).", said)
        self.assertEqual(len(list((self.folder / "kept").glob("building*.png"))), 3)
        self.measure("--swiftlet", self.bad)
        self.assertEqual(self.runs_of("bad"), 3)

    def test_other_settings_are_other_runs(self):
        settings = self.folder / "settings.toml"
        settings.write_text("[backend]\nrefine = false\n")
        self.measure("--swiftlet", self.good)
        self.measure("--swiftlet", self.good, "--config", settings)
        self.assertEqual(self.runs_of("good"), 6)

    def test_only_what_matches_is_run(self):
        self.measure("--swiftlet", self.good, "--only", "building 2")
        self.assertEqual(self.runs_of("good"), 1)
        self.assertIn("no run", self.measure("--swiftlet", self.good, "--only", "nothing", expected=2).stderr)

    def test_two_programs_are_compared_also_after_the_first_was_built_anew(self):
        said = self.measure("--swiftlet", self.bad)
        kept_as = said.stderr.splitlines()[0].split()[-1]
        self.program("bad", 0.1).write_text("#!/bin/sh\nexit 1\n")
        said = self.measure("--swiftlet", self.good, "--compare", kept_as).stdout
        self.assertIn("| **all** | 3 | 1 | 0 | 1 | 0 |", said)
        self.assertIn("| building 2 | mended | 2.000 (2.00) | 0.100 (0.10) |", said)

    def test_kept_runs_are_reported_and_none_made(self):
        self.measure("--swiftlet", self.good, "--only", "building 1")
        said = self.measure("--swiftlet", self.good, "--kept").stdout
        self.assertIn("| buildings | 1 |", said)
        self.assertEqual(self.runs_of("good"), 1)

    def test_a_program_that_is_missing_is_named(self):
        self.assertIn("no such", self.measure("--swiftlet", "/no such/program", expected=2).stderr)


class RecordedPage(unittest.TestCase):
    """Of buildings and robots 1 to 3, a log, and one whose data are missing."""

    def setUp(self):
        BenchmarkRobustness.setUp(self)
        for name in ("made.clf", "made.tum"):
            (self.folder / name).write_text("data\n")
        logs = [mapped_runs.Log(name, f"{name}.clf", f"{name}.tum") for name in ("made", "lost")]
        runs = [robustness_runs.Run(log, 4, None) for log in logs]
        robot_log = self.folder / "robot_log"
        robot_log.write_text('#!/bin/sh\necho log > "$2.clf"\necho true > "$2.tum"\necho offices\n')
        robot_log.chmod(0o755)
        for where, name, value in ((tool, "RECORDED_BUILDINGS", (1, 3)), (tool, "RECORDED_ROBOTS", (1, 3)),
                                   (robustness_runs, "ROBOT_LOG", robot_log), (mapped_runs, "DATASETS", self.folder),
                                   (robustness_runs, "ensemble_runs", lambda: runs),
                                   (robustness_runs, "plain_runs", lambda: runs),
                                   (robustness_runs, "piece_runs", lambda: runs),
                                   (tool.page, "RESULTS", self.folder / "results")):
            patch = mock.patch.object(where, name, value)
            patch.start()
            self.addCleanup(patch.stop)

    program = BenchmarkRobustness.program

    def record(self, kept=False):
        """The page."""
        self.image = mock.MagicMock()
        options = argparse.Namespace(output=self.folder / "kept", jobs=1, kept=kept, record=True, buildings=None,
                                     robots=None, plain=False, pieces=False, screen=False, only=None)
        circumstances = {"date": "2026-11-22", "commit": "abc", "machine": "some"}
        with mock.patch.object(tool.page, "record") as written, mock.patch("sys.stdout"), mock.patch("sys.stderr"):
            tool.record(options, self.bad, circumstances, self.image)
        return written.call_args.args[1]

    def test_it_names_the_data_that_were_missing(self):
        self.assertIn("Left out, for lack of data: lost.clf; lost.tum.", self.record())

    def test_it_has_a_picture_of_a_building_of_a_kind_that_breaks(self):
        self.assertIn("![map](robustness/building_2.png)", self.record())
        [call] = self.image.open.call_args_list
        self.assertEqual(call.args[0].read_text(), "picture\n")

    def test_it_has_the_robots(self):
        of_robots = self.record().split("## Robots with wheels")[1]
        self.assertIn("| offices | 3 | 0 | 0.0 |", of_robots)

    def test_kept_runs_are_recorded_only_where_all_exist(self):
        with self.assertRaisesRegex(LookupError, "1 of 1 runs are missing: record them without --kept"):
            self.record(kept=True)
        self.assertFalse((self.folder / "results").exists())
        self.assertEqual(self.record(), self.record(kept=True))


if __name__ == "__main__":
    unittest.main()

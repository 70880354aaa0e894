#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/robustness_runs.py draws the same ensembles each time, and keeps what comes of a run, also where it fails."""

import collections
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from pretended_report import REPORT

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import mapped_runs  # noqa: E402
import robustness_runs as runs  # noqa: E402


class RobustnessRuns(unittest.TestCase):
    def test_the_ensemble_is_large_enough_and_the_same_each_time(self):
        drawn = runs.ensemble_runs()
        self.assertGreaterEqual(len(set(drawn)), 300)
        self.assertEqual(drawn, runs.ensemble_runs())
        self.assertEqual(len(runs.screen_runs()), sum(ensemble.screened for ensemble in runs.ENSEMBLES))
        self.assertEqual({run.log.name for run in runs.screen_runs()}, {run.log.name for run in drawn})

    def test_each_log_has_few_beams_as_often_as_many_and_a_flight_its_own(self):
        groups = collections.Counter(run.group() for run in runs.ensemble_runs())
        for ensemble in runs.ENSEMBLES:
            if ensemble.is_laser:
                self.assertEqual(groups[ensemble.log.name + runs.FEW], ensemble.runs // 2)
                self.assertEqual(groups[ensemble.log.name + runs.MANY], ensemble.runs // 2)
            else:
                self.assertEqual(groups[ensemble.log.name], ensemble.runs)

    def test_starts_are_cut_and_poses_moved_within_the_limits(self):
        changes = [run.change for run in runs.ensemble_runs()]
        self.assertTrue(all(0.0 <= change.first <= runs.CUT_MAX and change.last == 1.0 for change in changes))
        self.assertTrue(all(abs(change.lead_s) <= runs.LEAD_MAX_S for change in changes))
        self.assertGreater(max(change.first for change in changes), 0.8 * runs.CUT_MAX)
        self.assertGreater(sum(change.first == 0.0 for change in changes), 0.2 * len(changes))

    def test_pieces_are_short_and_begin_anywhere(self):
        changes = [run.change for run in runs.piece_runs()]
        self.assertEqual(len(changes), runs.PIECES * len(runs.ENSEMBLES))
        self.assertTrue(all(0.0 <= change.first < change.last <= 1.0 for change in changes))
        self.assertLessEqual(max(change.last - change.first for change in changes), runs.PIECE_OF_FLIGHT[1] + 1e-9)
        self.assertLess(min(change.first for change in changes), 0.1)
        self.assertGreater(max(change.last for change in changes), 0.9)

    def test_flights_are_not_played_backwards(self):
        for ensemble in runs.ENSEMBLES:
            self.assertTrue(ensemble.is_laser or not any(change.backwards for change in ensemble.changes))

    def test_each_run_has_a_title_of_its_own(self):
        for drawn in (runs.ensemble_runs(), runs.screen_runs(), runs.plain_runs(), runs.piece_runs(),
                      runs.building_runs(1000, 1010)):
            self.assertEqual(len({run.title() for run in drawn}), len(drawn))

    def test_a_run_that_fails_is_a_result(self):
        with tempfile.TemporaryDirectory() as folder:
            swiftlet = Path(folder, "swiftlet")
            swiftlet.write_text("#!/bin/sh\necho 'it broke' >&2\nexit 3\n")
            swiftlet.chmod(0o755)
            results = runs.Results(Path(folder, "kept"), swiftlet)
            [run] = runs.building_runs(7, 7)
            results.make(run, at_once=1)
            self.assertEqual(results.get(run)["failed"], "exit code 3: it broke")
            self.assertIsNone(results.get(runs.with_settings(run, "[map]\n")))

    def test_true_poses_are_counted(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(mapped_runs, "DATASETS", Path(folder)):
            Path(folder, "a.tum").write_text("# stamp x y z qx qy qz qw\n1.0 0 0 0 0 0 0 1\n\n2.0 1 0 0 0 0 0 1\n")
            self.assertEqual(runs.true_poses(mapped_runs.Log("a flight", "a.pcap", "a.tum")), 2)

    def test_the_kind_of_a_building_is_kept(self):
        self.assertEqual(runs.figures_of(REPORT)["kind"], "maze")
        self.assertIsNone(runs.figures_of({**REPORT, "input": {"notes": []}})["kind"])

    def test_a_building_whose_kind_was_not_kept_is_run_again(self):
        with tempfile.TemporaryDirectory() as folder:
            swiftlet = Path(folder, "swiftlet")
            swiftlet.write_text("")
            results = runs.Results(Path(folder, "kept"), swiftlet)
            [building] = runs.building_runs(7, 7)
            log = runs.Run(mapped_runs.Log("a log", "a.clf", "a.tum"), 4, None)
            for run in (building, log):
                with mock.patch.object(results, "executed", lambda run: {"report": {"closures": 1}}):
                    results.make(run, at_once=1)
            self.assertIsNone(results.get(building))
            self.assertEqual(results.get(log)["report"], {"closures": 1})

    def test_a_robot_s_log_is_mapped_with_its_beams_and_its_building_s_kind_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            robot_log = Path(folder, "robot_log")
            robot_log.write_text('#!/bin/sh\necho "log of $1" > "$2.clf"\necho true > "$2.tum"\necho wings\n')
            robot_log.chmod(0o755)
            mapped = []

            def execute(run, *_):
                mapped.append((run.beams, Path(run.log.source).read_text(), Path(run.log.reference).read_text()))
                return {"report": {**REPORT, "input": {"notes": []}}}

            with (mock.patch.object(runs, "ROBOT_LOG", robot_log),
                  mock.patch.object(mapped_runs, "execute", execute)):
                robots = runs.robot_runs(7, 9)
                results = runs.Results(Path(folder, "kept"), robot_log)
                for run in robots:
                    results.make(run, at_once=1)
                self.assertEqual({results.get(run)["report"]["kind"] for run in robots}, {"wings"})
                robot_log.write_text("another")
                mapped_runs.content_digest.cache_clear()
                self.assertIsNone(results.get(runs.robot_runs(7, 7)[0]))
            self.assertEqual({beams for beams, _, _ in mapped}, set(runs.PLAIN_BEAMS))
            self.assertEqual([log for _, log, _ in mapped], ["log of 7\n", "log of 8\n", "log of 9\n"])
            self.assertEqual({truth for _, _, truth in mapped}, {"true\n"})

    def test_a_run_that_is_ended_from_outside_is_none(self):
        with tempfile.TemporaryDirectory() as folder:
            swiftlet = Path(folder, "swiftlet")
            swiftlet.write_text("#!/bin/sh\nkill -TERM $$\n")
            swiftlet.chmod(0o755)
            results = runs.Results(Path(folder, "kept"), swiftlet)
            [run] = runs.building_runs(7, 7)
            with self.assertRaises(subprocess.CalledProcessError):
                results.make(run, at_once=1)
            self.assertIsNone(results.get(run))

    def test_errors_are_metres_where_there_is_a_truth_else_cells(self):
        self.assertEqual(runs.error_of({"all": {"translation_m": {"mean": 0.5}}}), 0.5)
        self.assertEqual(runs.error_of({"rmse_m": 0.25}), 0.25)
        self.assertEqual(runs.error_of({"cells_10_cm": 900, "cells_20_cm": 400}), 400)
        self.assertEqual(runs.error_of({"cells_10_cm": 900}), 900)
        self.assertIsNone(runs.error_of(None))


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/whole_runs.py takes the right figures from reports, holds them against the limits, and cuts logs."""

import gzip
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import whole_runs  # noqa: E402


def stage(count, mean_ms, max_ms):
    return {"count": count, "mean_ms": mean_ms, "p50_ms": mean_ms / 2, "p99_ms": max_ms / 2, "max_ms": max_ms}


REPORT = {
    "backend": {"scans": 100, "keyframes": 10},
    "map": {"tiles": 4},
    "stage_times": {"input": stage(101, 0.0, 0.0), "frontend": stage(100, 0.1, 1.5), "backend": stage(100, 0.5, 20.0),
                    "final_pass": stage(1, 30.0, 30.0), "map": stage(1, 20.0, 20.0),
                    "pruning": stage(10, 1.0, 6.0)},
    "run_peak_memory_mb": 20.0,
    "peak_memory_mb": 30.0,
}


class WholeRuns(unittest.TestCase):
    def test_the_mean_spreads_every_stage_over_the_scans(self):
        figures = whole_runs.figures_of(REPORT)
        self.assertAlmostEqual(figures["mean_per_scan_ms"], 0.1 + 0.5 + 0.3 + 0.2 + 0.1)
        self.assertAlmostEqual(figures["slam_per_scan_ms"], 0.1 + 0.5 + 0.3 + 0.1)
        self.assertEqual(figures["backend_max_ms"], 20.0, "the final pass is none of the backend's calls")
        self.assertEqual(figures["final_pass_ms"], 30.0)
        self.assertEqual(figures["map_ms"], 20.0)
        self.assertEqual(figures["pruning_max_ms"], 6.0)

    def test_of_several_runs_maxima_are_the_least_and_the_rest_medians(self):
        runs = [{"frontend_max_ms": m, "mean_per_scan_ms": m} for m in (5.0, 1.0, 2.0)]
        self.assertEqual(whole_runs.combined(runs), {"frontend_max_ms": 1.0, "mean_per_scan_ms": 2.0})

    def test_each_limit_is_exceeded_on_its_own(self):
        good = {"frontend_max_ms": 2.0, "backend_max_ms": 150.0, "pruning_max_ms": 150.0, "mean_per_scan_ms": 0.5}
        self.assertEqual(whole_runs.over_limits("a log", good, their_mean_ms=2.0), [])
        for key, value, part in [("frontend_max_ms", 2.1, "frontend 2.1 ms, limit 2 ms"),
                                 ("backend_max_ms", 151.0, "backend 151 ms, limit 150 ms"),
                                 ("pruning_max_ms", 151.0, "pruning 151 ms, limit 150 ms"),
                                 ("mean_per_scan_ms", 0.6, "mean per scan 0.6 ms, limit 0.5 ms")]:
            [line] = whole_runs.over_limits("a log", {**good, key: value}, their_mean_ms=2.0)
            self.assertTrue(line.startswith("a log: "), line)
            self.assertIn(part, line)
        self.assertEqual(whole_runs.over_limits("a flight", {**good, "mean_per_scan_ms": 9.0}), [])

    def test_a_cut_log_ends_with_the_share_of_its_scans(self):
        lines = ["# a comment\n", "ODOM 1\n", *(f"{kind} {i}\n" for i in range(8) for kind in ("FLASER", "ODOM"))]
        with tempfile.TemporaryDirectory() as folder:
            log, cut = Path(folder, "log.clf.gz"), Path(folder, "cut.clf")
            with gzip.open(log, "wt") as file:
                file.writelines(lines)
            whole_runs.cut_laser_log(log, 0.25, cut)
            self.assertEqual(cut.read_text(), "".join(lines[:5]))
            whole_runs.cut_laser_log(log, 1.0, cut)
            self.assertEqual(cut.read_text(), "".join(lines[:-1]))
            with gzip.open(log, "wt") as file:
                file.write("ODOM 1\n")
            with self.assertRaises(ValueError):
                whole_runs.cut_laser_log(log, 1.0, cut)

    def test_a_refused_input_raises_with_what_was_said(self):
        with tempfile.TemporaryDirectory() as folder:
            refuses = Path(folder, "refuses")
            refuses.write_text("#!/bin/sh\necho 'no such log' >&2\nexit 2\n")
            refuses.chmod(0o755)
            with self.assertRaises(subprocess.CalledProcessError) as raised:
                whole_runs.run(refuses, ["a.clf"], folder)
            self.assertIn("no such log", raised.exception.stderr)


if __name__ == "__main__":
    unittest.main()

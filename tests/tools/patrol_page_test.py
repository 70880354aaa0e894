#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/patrol_page.py runs the lengths that it reports, and writes their figures."""

import json
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import patrol_page  # noqa: E402

STAGE = {"count": 100, "mean_ms": 0.5, "p50_ms": 0.1, "p99_ms": 0.7, "max_ms": 1.5}
REPORT = {
    "backend": {"scans": 100, "scans_pruned": 60, "keyframes": 10},
    "map": {"tiles": 4},
    "trajectory": {"duration_s": 5400},
    "absolute_trajectory_error": {"corrected": {"rmse_m": 0.0625}},
    "stage_times": {stage: STAGE for stage in ("input", "frontend", "backend", "pruning", "final_pass", "map")},
    "run_peak_memory_mb": 20.0,
    "peak_memory_mb": 30.0,
}
FAKE = """#!/bin/sh
echo "$2" >> {log}
mkdir -p "$4" && cp {report} "$4/report.json"
"""


class PatrolPage(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        folder = Path(self.folder.name)
        self.log, report = folder / "log", folder / "report"
        report.write_text(json.dumps(REPORT))
        swiftlet = folder / "swiftlet"
        swiftlet.write_text(FAKE.format(log=self.log, report=report))
        swiftlet.chmod(0o755)
        self.said = []
        self.rows = patrol_page.measure(swiftlet, folder / "out", self.said.append)

    def test_each_length_is_flown_once_the_shortest_first(self):
        self.assertEqual(self.log.read_text().split(),
                         [f"sim://patrol?seed=1&laps={laps}" for laps in (78, 235, 470, 940)])
        self.assertEqual(self.said, [f"patrol of {hours} h" for hours in (1, 3, 6, 12)])

    def test_a_row_has_the_scans_kept_and_the_scans_pruned(self):
        row = self.rows[0]
        self.assertEqual((row["samples"], row["scans_pruned"], row["scans_kept"]), (100, 60, 40))
        self.assertEqual(row["hours"], 1.5)

    def test_the_page_holds_a_line_for_each_length_and_what_is_over_a_limit(self):
        report = {"date": "2026-01-02", "commit": "abc", "machine": "a machine", "patrol": self.rows,
                  "over_limits": ["patrol of 3 h: too slow"]}
        text = patrol_page.document(report, lambda value: f"<{value:g}>")
        self.assertIn("`tools/benchmark-speed --patrol --record` on 2026-01-02, commit abc", text)
        self.assertIn("| 1.5 | 940 | <100> | <60> | <40> | <10> |", text)
        self.assertIn("- patrol of 3 h: too slow", text)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/fault_runs.py measures the way until a vehicle found back, and tools/fault_page.py writes it down."""

import cmath
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import fault_page as page  # noqa: E402
import fault_runs as runs  # noqa: E402

SPEED_M_S = 0.5
PRETENDS = """#!/bin/sh
echo '{"absolute_trajectory_error": {"corrected": {"rmse_m": 0.25}}}' > "$4/report.json"
for i in 0 149 160 170; do echo "$i $i 0 0 0 0 0 1"; done | tee "$4/ground_truth.tum" > "$4/live.tum"
"""


def flight(seconds=40):
    """{stamp in ms: true pose}: east, then north, a pose each second from the stamp of 5 s on."""
    def pose(i):
        return SPEED_M_S * min(i, 10), SPEED_M_S * max(i - 10, 0), 0.0

    return {5000 + 1000 * i: pose(i) for i in range(seconds + 1)}


def published(truth, off_m=lambda s: 0.0):
    """The flight in a frame of its own; `off_m`: error by the time after the first pose."""
    def pose(stamp, true):
        turned = cmath.exp(1.2j) * complex(true[0] + off_m((stamp - 5000) / 1000), true[1]) + complex(3, -7)
        return turned.real, turned.imag, 0.0

    return {stamp: pose(stamp, true) for stamp, true in truth.items()}


class WayBack(unittest.TestCase):
    def test_it_is_the_way_from_the_end_of_the_break_until_the_live_pose_is_near_for_good(self):
        truth = flight()
        live = published(truth, lambda s: {25: 0.0}.get(s, 2.0 if 20 <= s < 32 else 0.4))
        self.assertAlmostEqual(runs.way_back_m(truth, live, 20, 20), 6.0, msg="near for a moment at 25 s")
        self.assertAlmostEqual(runs.way_back_m(truth, live, 20, 28), 2.0)

    def test_who_is_off_at_the_end_did_not_find_back(self):
        truth = flight()
        self.assertIsNone(runs.way_back_m(truth, published(truth, lambda s: 0.6 if s == 40 else 0.0), 20, 20))

    def test_a_vehicle_that_was_never_lost_has_no_way(self):
        truth = flight()
        self.assertEqual(runs.way_back_m(truth, published(truth), 20, 20), 0.0)

    def test_what_is_flown_unseen_after_the_break_counts(self):
        truth = flight()
        live = {stamp: pose for stamp, pose in published(truth).items() if not 25000 <= stamp < 37000}
        self.assertAlmostEqual(runs.way_back_m(truth, live, 20, 20), 6.0)


class FaultRuns(unittest.TestCase):
    def test_each_fault_is_flown_in_each_world_with_each_seed(self):
        titles = [run.title() for run in runs.all_runs()]
        self.assertEqual(len(set(titles)), len(runs.WORLDS) * len(runs.FAULTS) * 10)
        self.assertEqual(titles[:len(titles) // 5], [run.title() for run in runs.all_runs(2)])
        self.assertIn("sim://office?seed=1", titles)
        self.assertIn("sim://maze?seed=10&fault=reset@150", titles)
        self.assertIn("sim://office?seed=2&fault=carried@150:60", titles)

    def test_a_break_that_takes_time_in_the_air_ends_when_that_is_over(self):
        self.assertEqual([runs.Fault(kind, 60).end_s() for kind in ("silence", "carried", "restart")], [210, 210, 150])
        self.assertEqual(runs.Fault("reset").end_s(), 150)

    def test_a_run_has_its_final_error_and_its_way_back_where_the_input_tells_of_the_break(self):
        with tempfile.TemporaryDirectory() as name:
            program = Path(name, "swiftlet")
            program.write_text(PRETENDS)
            program.chmod(0o755)
            results = runs.Results(Path(name, "kept"), program)
            told, untold = (runs.run_of("maze", 3, fault) for fault in (runs.Fault("reset"), runs.Fault("slip", 6)))
            for run in (told, untold):
                results.make(run, at_once=1)
            self.assertEqual(results.get(told)["way_back_m"], 0.0)
            self.assertEqual(results.get(untold)["final_m"], 0.25)
            self.assertNotIn("way_back_m", results.get(untold))


class FaultPage(unittest.TestCase):
    def test_a_line_has_the_runs_of_one_fault_in_one_world(self):
        results = [{"final_m": final, "way_back_m": way}
                   for final, way in ((0.1, 4.0), (0.12, 8.0), (0.2, 3.0), (3.0, None))]
        self.assertEqual(page.cells(results), ["4", "0.160", "3.000", "50 %", "25 %", "75 %", "4.0", "8.0"])
        self.assertEqual(page.cells([{"final_m": 0.1}])[5:], ["–", "–", "–"])
        self.assertEqual(page.cells([{"final_m": 0.1, "way_back_m": None}])[5:], ["0 %", "–", "–"])

    def test_a_tenth_of_the_values_exceeds_p90(self):
        self.assertEqual(page.p90(range(10, 0, -1)), 9)
        self.assertEqual(page.p90([7]), 7)

    def test_the_page_has_a_table_for_each_world(self):
        rows = [(runs.run_of(world, 1, runs.Fault("silence", 31)), {"final_m": final, "way_back_m": 1.0})
                for world, final in (("office", 0.1), ("maze", 0.5))]
        text = page.document({"date": "2026-01-02", "commit": "abc", "machine": "a machine", "seeds": 1, "rows": rows})
        self.assertIn("`tools/benchmark-faults --record` on 2026-01-02, commit abc", text)
        office, _, maze = text.partition("## office")[2].partition("## maze")
        self.assertIn("| `silence@150:31` | 1 | 0.100 | 0.100 |", office)
        self.assertIn("| `silence@150:31` | 1 | 0.500 | 0.500 |", maze)

    def test_the_page_names_the_runs_that_were_told_and_are_wrong_nonetheless(self):
        kinds = (("reset", 3.0), ("restart", 0.9), ("slip", 3.0))
        rows = [(runs.run_of("maze", 1, runs.Fault(kind)), {"final_m": final}) for kind, final in kinds]
        self.assertEqual(page.wrong_though_told(rows), "- `sim://maze?seed=1&fault=reset@150`: 3.0 m")
        self.assertEqual(page.wrong_though_told(rows[1:]), "- none")


if __name__ == "__main__":
    unittest.main()

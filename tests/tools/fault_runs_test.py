#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/fault_runs.py measures how a vehicle finds back and whether it doubts, and tools/fault_page.py writes it down."""

import dataclasses
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import confidence_runs  # noqa: E402
import doubt_runs  # noqa: E402
import fault_page as page  # noqa: E402
import fault_runs as runs  # noqa: E402
import log_sharpness  # noqa: E402
import robustness_runs  # noqa: E402
import whole_runs  # noqa: E402

PRETENDS = """#!/bin/sh
if [ "$1" = map ]; then
  echo '{"absolute_trajectory_error": {"corrected": {"rmse_m": 0.25}}}' > "$4/report.json"
  for i in 0 149 160 170 171; do echo "$i $i 0 0 0 0 0 1"; done > "$4/ground_truth.tum"
  for i in 0 149 160 170 171; do echo "$i 5 $i 0 0 0 0 1"; done > "$4/trajectory.tum"
else
  echo '{"live": {"errors_m": [[149, 0], [160, 2], [170, 0.1], [171, 0.1]]}, "consistency": {"seconds_doubted": 12.5},
         "poses": [[149, 0, 0, 0, 0, 0, "tracking"], [160, 0, 0, 0, 0, 0, "lost"], [170, 0, 0, 0, 0, 0, "tracking"],
                   [171, 0, 0, 0, 0, 0, "tracking"]]}'
fi
"""


def after(*errors_m, states="", step_m=1.0):
    """Moments 0.5 s and one step apart. `states`: a letter each, t for tracking; all are where there are none."""
    names = {"t": "tracking", "u": "uncertain"}
    return [runs.Moment(40 + 0.5 * i, 20 + step_m * i, error_m, names[states[i] if states else "t"])
            for i, error_m in enumerate(errors_m)]


class Moments(unittest.TestCase):
    TRUTH = {1000 * s: (0.5 * min(s, 10), 0.5 * max(s - 10, 0), 0.0) for s in range(5, 46)}

    def test_they_are_those_behind_the_break_with_way_error_and_state(self):
        evaluation = {"live": {"errors_m": [[24.0, 0.1], [25.0, 0.2], [27.0, 0.3]]},
                      "poses": [[float(s), 0, 0, 0, 0, 0, "tracking" if s < 26 else "lost"] for s in range(5, 46)]}
        self.assertEqual(runs.moments(evaluation, self.TRUTH, end_s=20),
                         [runs.Moment(25.0, 10.0, 0.2, "tracking"), runs.Moment(27.0, 11.0, 0.3, "lost")])


class Faults(unittest.TestCase):
    def test_a_silence_is_told_in_the_order_of_time(self):
        self.assertEqual(runs.Fault("turn", 30, silent_at_s=20).text(), "silence@20:2,turn@150:30")
        self.assertEqual(runs.Fault("carried", 60, silent_at_s=214).text(), "carried@150:60,silence@214:2")


class WrongPlace(unittest.TestCase):
    def wrong_way_m(self, off_m, fault=runs.Fault("turn", 20)):
        """Of a flight of 300 s at 0.5 m/s whose final path is turned by 90 degrees. `off_m`: of stamp."""
        truth = {500 * i: (0.25 * i, 0.0, 0.0) for i in range(601)}
        final = {stamp: (-off_m(stamp / 1000) - 7.0, x_m, 0.0) for stamp, (x_m, _, _) in truth.items() if stamp != 7000}
        return runs.path_figures(final, truth, fault)["wrong_way_m"]

    def test_a_map_that_is_only_turned_and_moved_is_right(self):
        self.assertEqual(self.wrong_way_m(lambda s: 0.0), 0.0)

    def test_a_wrong_end_is_not_levelled_out_by_the_rest(self):
        self.assertAlmostEqual(self.wrong_way_m(lambda s: 1.5 if s >= 270 else 0.0), 15.25)

    def test_a_wrong_middle_counts_though_the_end_is_right(self):
        self.assertAlmostEqual(self.wrong_way_m(lambda s: 1.5 if 200 <= s < 220 else 0.0), 10.0)

    def test_what_is_flown_before_the_break_ends_does_not_count(self):
        self.assertEqual(self.wrong_way_m(lambda s: 1.5 if 150 <= s < 180 else 0.0, runs.Fault("silence", 30)), 0.0)

    def test_a_way_that_nobody_saw_does_not_count(self):
        truth = {500 * i: (0.25 * i, 0.0, 0.0) for i in [*range(320), *range(380, 390)]}
        final = {stamp: (x_m, 2.0 if stamp >= 150000 else 0.0, 0.0) for stamp, (x_m, _, _) in truth.items()}
        self.assertAlmostEqual(runs.path_figures(final, truth, runs.Fault("slip", 6))["wrong_way_m"], 4.75 + 2.25)

    def test_the_map_of_before_is_judged_by_itself(self):
        truth = {1000 * s: (0.5 * s, 0.0, 0.0) for s in range(300)}
        final = {stamp: (x_m, 9.0 if stamp >= 150000 else 0.1 if stamp % 2000 else -0.1, 0.0)
                 for stamp, (x_m, _, _) in truth.items()}
        self.assertAlmostEqual(runs.path_figures(final, truth, runs.Fault("turn", 20))["before_m"], 0.1, places=3)


class WayBack(unittest.TestCase):
    def test_it_is_the_way_from_the_first_old_ground_until_the_pose_is_near_and_stays_so(self):
        self.assertEqual(runs.way_back_m(after(2, 2, 0.4, 2, 0.4, 0.4, 0.4, 0.4, 0.4, 0.4, 2)), 4.0)

    def test_who_leaves_before_the_end_did_not_find_back(self):
        self.assertIsNone(runs.way_back_m(after(2, 0.4, 0.4, 0.4, 0.6)))

    def test_who_is_near_until_the_end_did_if_that_is_some_way_off(self):
        self.assertEqual(runs.way_back_m(after(2, 2, 0.4, 0.4)), 2.0)
        self.assertIsNone(runs.way_back_m(after(2, 2, 0.4)), "near at the last sample alone")
        self.assertIsNone(runs.way_back_m(after(2, 0.4, 0.4, step_m=0.5)))

    def test_a_vehicle_that_was_never_lost_has_no_way(self):
        self.assertEqual(runs.way_back_m(after(0.1, 0.2, 0.3, 0.2, 0.1, 0.1, 2)), 0.0)


class Doubt(unittest.TestCase):
    def noticed_s(self, *errors_m, states=""):
        moments = after(*errors_m, states=states)
        return runs.noticed_s(moments, [moment.stamp_s for moment in moments if moment.state != runs.SURE])

    def test_it_comes_so_long_after_the_error_has_passed_the_limit(self):
        self.assertEqual(self.noticed_s(0.2, 0.9, 1.1, 1.5, 2, states="ttttu"), 1.0)

    def test_it_may_have_begun_before_or_never_come(self):
        self.assertEqual(self.noticed_s(0.2, 0.9, 1.1, states="tuu"), 0.0)
        self.assertIsNone(self.noticed_s(0.2, 0.9, 1.1))

    def test_what_ended_before_does_not_count(self):
        self.assertIsNone(self.noticed_s(0.2, 0.9, 1.1, states="utt"))

    def test_it_is_too_late_where_the_pose_is_right_again(self):
        self.assertIsNone(self.noticed_s(2, 0.6, 0.4, 0.4, 2, states="ttttu"))
        self.assertEqual(self.noticed_s(2, 0.6, 0.4, 0.4, 2, states="ttutt"), 1.0, "it came with the right pose")
        self.assertEqual(self.noticed_s(2, 0.6, 0.9, states="ttu"), 1.0, "it was not right yet")

    def test_it_may_come_where_no_place_is_known(self):
        self.assertEqual(runs.noticed_s(after(2, 2), [39.0, 40.25, 40.5]), 0.25)

    def test_the_way_counts_that_is_published_as_good_far_off(self):
        self.assertEqual(runs.believed_m(after(2, 2, 2, 0.9, 2, states="utttt")), 3.0)

    def test_the_way_without_old_ground_does_not_count(self):
        there = after(2, 2, 2)
        elsewhere = [dataclasses.replace(moment, stamp_s=moment.stamp_s + 60, way_m=moment.way_m + 30) for moment in there]
        self.assertEqual(runs.believed_m(there + elsewhere), 4.0)


class FaultRuns(unittest.TestCase):
    def test_each_fault_is_flown_in_each_world_with_each_seed(self):
        titles = [run.title() for run in runs.all_runs()]
        self.assertEqual(len(set(titles)), (len(runs.WORLDS) * len(runs.FAULTS) + 1) * 10)
        self.assertEqual(titles[:len(titles) // 5], [run.title() for run in runs.all_runs(2)])
        self.assertIn("sim://office?seed=1", titles)
        self.assertIn("sim://maze?seed=10&fault=reset@150", titles)
        self.assertIn("sim://office?seed=3&fault=restart@80:60", titles)
        self.assertIn("sim://office?seed=2&fault=carried@150:60", titles)
        self.assertIn("sim://maze?seed=2&fault=carried@150:60,silence@214:2", titles)

    def test_a_break_that_takes_time_in_the_air_ends_when_that_is_over(self):
        self.assertEqual([runs.Fault(kind, 60).end_s() for kind in ("silence", "carried", "restart")], [210, 210, 150])
        self.assertEqual(runs.Fault("reset").end_s(), 150)
        self.assertEqual(runs.Fault("carried", 60, at_s=80).end_s(), 140)
        self.assertEqual(runs.Fault("carried", 60, 144, at_s=80).text(), "carried@80:60,silence@144:2")

    def test_a_run_has_its_final_error_and_what_its_moments_tell(self):
        with tempfile.TemporaryDirectory() as name:
            program = Path(name, "swiftlet")
            program.write_text(PRETENDS)
            program.chmod(0o755)
            results = runs.Results(Path(name, "kept"), program)
            run = runs.run_of("maze", 3, runs.Fault("slip", 6))
            results.make(run, at_once=1)
            figures = {"final_m": 0.25, "wrong_way_m": 0, "way_back_m": 10.0, "believed_m": 0, "noticed_s": 0.0,
                       "doubted_s": 12.5}
            self.assertLessEqual(figures.items(), results.get(run).items())

    def test_figures_by_other_code_of_ours_are_not_taken(self):
        run = runs.run_of("maze", 3, runs.Fault("slip", 6))
        kept = ((runs, (runs, doubt_runs, log_sharpness)), (confidence_runs, (confidence_runs,)),
                (robustness_runs, (whole_runs,)))
        for maker, modules in kept:
            results = maker.Results(Path("kept"), __file__)
            for module in modules:
                before = results.file(run)
                with mock.patch.object(module, "__file__", __file__):
                    self.assertNotEqual(results.file(run), before, (maker.__name__, module.__name__))

    def test_figures_that_mean_nothing_in_a_run_are_absent(self):
        self.assertEqual(runs.figures(runs.Fault("turn", 20), [], []), {})
        self.assertEqual(runs.figures(runs.Fault("turn", 20), after(0.1, 0.1, step_m=0.9), []), {}, "hardly a way")
        self.assertNotIn("noticed_s", runs.figures(runs.Fault("turn", 20), after(0.1, 0.2), []))
        self.assertNotIn("noticed_s", runs.figures(runs.Fault("reset"), after(2, 2), []))


class FaultPage(unittest.TestCase):
    def test_a_line_has_the_runs_of_one_fault_in_one_world(self):
        keys = "final_m", "wrong_way_m", "way_back_m", "believed_m", "noticed_s", "before_m", "doubted_s"
        results = [dict(zip(keys, figures)) for figures in
                   ((0.1, 0, 4.0, 0.0, 1.0, 0.05, 0.0), (0.12, 5.0, 16.0, 0.9, 0.0, 0.07, 12.0),
                    (0.2, 9.0, 3.0, 2.0, 7.0, 0.06, 20.0), (3.0, 2.0, None, 9.0, None, 0.05, 80.0))]
        self.assertEqual(page.cells(results), ["4", "0.160", "3.000", "50 %", "0.070", "25 %", "75 % of 4", "4.0", "16.0",
                                               "50 %", "75 %", "50 % of 4", "16", "75 % of 4", "4.0", "never"])
        bare = {"final_m": 0.1, "wrong_way_m": 0, "before_m": 0.1, "doubted_s": 0.0}
        self.assertEqual(page.cells([bare])[6:], [*["–"] * 6, "0", *["–"] * 3])
        self.assertEqual(page.cells([{**bare, "way_back_m": None}])[6:11], ["0 % of 1", "–", "–", "0 %", "0 %"])

    def test_shares_say_of_how_many_runs_they_are(self):
        unknown = {"final_m": 0.1, "wrong_way_m": 0, "before_m": 0.1, "doubted_s": 0.0}
        known = {**unknown, "way_back_m": 3.0, "believed_m": 2.0}
        cells = page.cells([unknown, known, known])
        self.assertEqual((cells[0], cells[6], cells[11]), ("3", "100 % of 2", "100 % of 2"))

    def test_a_doubt_that_never_came_is_longer_than_any(self):
        self.assertEqual(page.doubt_cells([3.0] * 9 + [None]), ["90 % of 10", "3.0", "3.0"], "one in ten may be missed")
        self.assertEqual(page.doubt_cells([3.0] * 8 + [None] * 2), ["80 % of 10", "3.0", "never"])
        self.assertEqual(page.doubt_cells([0.5] + [None] * 9), ["10 % of 10", "never", "never"])

    def test_a_tenth_of_the_values_exceeds_p90(self):
        self.assertEqual(page.p90(range(10, 0, -1)), 9)
        self.assertEqual(page.p90([7]), 7)

    def test_the_page_has_a_table_for_each_world(self):
        rows = [(runs.run_of(world, 1, runs.Fault("silence", 31)),
                 {"final_m": final, "wrong_way_m": 0, "way_back_m": 1.0, "before_m": 0.1, "doubted_s": 0.0})
                for world, final in (("office", 0.1), ("maze", 0.5))]
        text = page.document({"date": "2026-01-02", "commit": "abc", "machine": "a machine", "seeds": 1, "rows": rows})
        self.assertIn("`tools/benchmark-faults --record` on 2026-01-02, commit abc", text)
        self.assertIn("have an easier sensor", text)
        office, _, maze = text.partition("## office")[2].partition("## maze")
        self.assertIn("| `silence@150:31` | 1 | 0.100 | 0.100 |", office)
        self.assertIn("| `silence@150:31` | 1 | 0.500 | 0.500 |", maze)

    def test_the_page_names_the_runs_that_were_told_and_are_wrong_nonetheless(self):
        kinds = (("reset", 30.0), ("restart", 4.9), ("slip", 30.0))
        rows = [(runs.run_of("maze", 1, runs.Fault(kind)), {"wrong_way_m": way}) for kind, way in kinds]
        self.assertEqual(page.wrong_though_told(rows), "- `sim://maze?seed=1&fault=reset@150`: over 30 m")
        self.assertEqual(page.wrong_though_told(rows[1:]), "- none")


if __name__ == "__main__":
    unittest.main()

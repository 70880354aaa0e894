#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/robustness_page.py counts break-outs, with their interval, and compares two sets of runs."""

import statistics
import sys
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import robustness_page as rates  # noqa: E402
import robustness_runs as runs  # noqa: E402
from changed_log import Change  # noqa: E402

LOG, FR079, FHW, RICE = (next(ensemble.log for ensemble in runs.ENSEMBLES if ensemble.log.name == name)
                   for name in ("Robot 4", "FR079", "FHW", "Rice Hall"))
REPORT = {"mean_per_scan_ms": 0.2, "backend_max_ms": 30.0}
PAGE = {"date": "2026-11-22", "commit": "abc", "machine": "some", "missing": []}


def run(number, beams=4, log=LOG):
    return runs.Run(log, beams, Change("noise 1", noise=1.0, seed=number))


def result(error, odometry):
    return {"final": {"rmse_m": error}, "live": {"rmse_m": 2.0 * error}, "odometry": {"rmse_m": odometry},
            "report": REPORT, "at_once": 1}


def made(errors, beams=4, odometry=10.0, log=LOG):
    return [rates.outcome(run(number, beams, log), result(error, odometry)) for number, error in enumerate(errors)]


def buildings(others):
    """20 buildings, all of them offices of ratio 0.1 but for `others`: {seed: (ratio, kind)}."""
    found = []
    for one in runs.building_runs(1, 20):
        ratio, kind = others.get(int(one.log.name.split()[1]), (0.1, "offices"))
        found.append(rates.outcome(one, {**result(ratio, 1.0), "report": {**REPORT, "kind": kind}}))
    return found


def robots(ratios):
    """30 robots in offices, of ratio 0.1 but for `ratios`: {seed: ratio}."""
    report = {**REPORT, "kind": "offices"}
    with mock.patch.object(runs, "ROBOT_LOG", Path(__file__)):
        return [rates.outcome(one, {**result(ratios.get(int(runs.seed_of(one.log)), 0.1), 1.0), "report": report})
                for one in runs.robot_runs(1, 30)]


class RobustnessPage(unittest.TestCase):
    def test_a_run_far_over_the_best_quarter_breaks_out(self):
        group = made([0.1, 0.1, 0.1, 0.14, 0.16])
        limits = rates.Quarters(group)
        self.assertEqual([rates.breaks_out(one, limits) for one in group], [False, False, False, False, True])

    def test_many_beams_are_held_against_few_where_those_are_better(self):
        few, many = made([0.1] * 4), made([0.3] * 4, beams=11)
        limits = rates.Quarters(few + many)
        self.assertTrue(rates.breaks_out(many[0], limits))
        self.assertFalse(rates.breaks_out(few[0], limits))
        self.assertFalse(rates.breaks_out(many[0], rates.Quarters(many)))

    def test_a_whole_run_is_not_held_against_a_cut_one_whose_relations_are_easier(self):
        each = [[0.75, 0.25], [0.75, 0.25], [None, 0.125], [None, 0.125], [None, 0.25], [0.75, 0.5]]
        group = [rates.outcome(run(number), {**result(0.0, 1.0), "final": {
            "all": {"translation_m": {"mean": statistics.fmean(filter(None, errors))}, "rotation_deg": {"mean": 1.0}},
            "each_translation_m": errors}})
            for number, errors in enumerate(each)]
        limits = rates.Quarters(group)
        self.assertEqual([limits.of(one) for one in group], [0.5, 0.5, 0.125, 0.125, 0.125, 0.5])
        self.assertEqual([rates.breaks_out(one, limits) for one in group], [False, False, False, False, True, False])

    def test_a_log_on_which_every_run_is_bad_has_break_outs(self):
        group = made([5.0, 5.0], log=FR079)
        self.assertTrue(all(rates.breaks_out(one, rates.Quarters(group)) for one in group))

    def test_fr079_is_held_against_the_relations_and_what_is_attainable_by_them(self):
        self.assertEqual(FR079.reference, "radish/fr079.relations")
        few, many = made([0.119, 0.121], log=FR079), made([0.082, 0.083], beams=11, log=FR079)
        limits = rates.Quarters(few + many)
        self.assertEqual([rates.breaks_out(one, limits) for one in few + many], [False, True, False, True])

    def test_where_the_reference_is_an_estimate_only_dead_reckoning_counts(self):
        group = made([0.1, 0.1, 0.5, 0.6], odometry=0.55, log=FHW)
        limits = rates.Quarters(group)
        self.assertEqual([rates.breaks_out(one, limits) for one in group], [False, False, False, True])
        self.assertIn("seed 3, +0 ms | 0.600 | – | 1.09 |", rates.tables(group))

    def test_a_run_worse_than_dead_reckoning_breaks_out(self):
        for odometry, expected in ((1.0, False), (0.99, False), (0.97, True)):
            [one] = made([1.0], odometry=odometry)
            self.assertEqual(rates.breaks_out(one, rates.Quarters([one])), expected)

    def test_a_run_that_failed_breaks_out(self):
        one = rates.outcome(run(0), {"failed": "exit code 2: no sample"})
        self.assertTrue(rates.breaks_out(one, rates.Quarters()))
        self.assertIn("exit code 2: no sample", rates.tables([one]))

    def test_a_run_without_a_trajectory_failed(self):
        for lacks, said in (("final", "no final trajectory"), ("odometry", "no dead reckoning")):
            one = rates.outcome(run(0), {**result(0.1, 1.0), lacks: None})
            self.assertEqual((one.failed, one.error, one.ratio), (said, None, None))

    def test_a_group_of_runs_that_all_failed_has_a_whole_row(self):
        one = rates.outcome(run(0), {"failed": "exit code 2: no sample"})
        self.assertIn(f"| Robot 4{runs.FEW} | 1 | – | – | – | – |", rates.groups_table([one], rates.Quarters()))

    def test_cells_are_held_against_those_of_dead_reckoning(self):
        one = rates.outcome(run(0), {**result(1.0, 1.0), "final": {"cells_10_cm": 80}, "odometry": {"cells_10_cm": 100}})
        self.assertEqual((one.error, one.ratio), (0.8, 0.8))
        self.assertFalse(one.exceeds(0.65))
        self.assertTrue(one.exceeds(0.63))

    def test_the_interval_is_wilson_s(self):
        low, high = rates.interval(2, 100)
        self.assertAlmostEqual(low, 0.0055, places=4)
        self.assertAlmostEqual(high, 0.0700, places=4)
        self.assertEqual(rates.interval(0, 50)[0], 0.0)
        self.assertEqual(rates.interval(0, 0), (0.0, 1.0))

    def test_runs_of_one_log_count_together_in_the_interval_of_all(self):
        logs = [(0, 10), (0, 10), (0, 10), (5, 10)]
        low, high = rates.interval_over_logs(logs)
        self.assertEqual(low, 0.0)
        self.assertGreater(high, rates.interval(5, 40)[1])
        self.assertEqual((low, high), rates.interval_over_logs(logs))

    def test_logs_that_all_have_one_rate_show_no_interval(self):
        for logs in ([], [(3, 10)], [(0, 10), (0, 10)]):
            self.assertIsNone(rates.interval_over_logs(logs))

    def test_runs_without_truth_stand_apart(self):
        group = made([0.1, 0.1, 0.1, 0.9]) + made([0.1] * 4, beams=None, log=RICE) + made([0.1] * 4, log=FHW)
        text = rates.rates_table(group, rates.Quarters(group))
        self.assertIn("| **with truth** | 4 | 1 | 25.0 | – | 1 |", text)
        self.assertIn("| **all** | 12 | 1 | 8.3 | 0.0 to 25.0 | 1 |", text)
        self.assertNotIn("with truth", rates.rates_table(made([0.1], log=FHW), rates.Quarters()))

    def test_a_comparison_lists_what_was_mended_and_what_broke(self):
        before, after = made([0.1, 0.1, 0.1, 0.5]), made([0.1, 0.1, 0.4, 0.1])
        text = rates.comparison(before, after)
        self.assertIn("| **all** | 4 | 1 | 1 | 1 | 1 |", text)
        self.assertIn("seed 3, +0 ms | mended | 0.500 (0.05) | 0.100 (0.01) |", text)
        self.assertIn("seed 2, +0 ms | **broken** | 0.100 (0.01) | 0.400 (0.04) |", text)

    def test_both_sets_are_held_against_the_better_one(self):
        text = rates.comparison(made([0.5] * 4), made([0.1] * 4))
        self.assertIn("| **all** | 4 | 4 | 0 | 4 | 0 | 0.200 |", text)

    def test_runs_are_compared_though_their_settings_differ(self):
        other = [rates.outcome(runs.with_settings(one.run, "[map]\n"), result(0.1, 1.0)) for one in made([0.1])]
        self.assertIn("| **all** | 1 | 0 | 0 |", rates.comparison(made([0.1]), other))

    def test_buildings_are_summed_up(self):
        built = buildings({7: (2.0, "maze")})
        text = rates.buildings_text(built)
        self.assertIn("| final error over 1.02 times that of dead reckoning, % | 5.0 (0.9 to 23.6) |", text)
        self.assertIn("| median ratio to dead reckoning | 0.100 |", text)
        self.assertIn("Over 1.02 times, seed (kind, ratio): 7 (maze, 2.00).", text)
        self.assertIn("No run", rates.buildings_text([]))

    def test_buildings_are_told_by_kind(self):
        text = rates.buildings_text(buildings({3: (1.5, "maze"), 4: (0.5, "maze"), 5: (1.01, "maze")}))
        self.assertIn("| published poses: error over 1.02 times that of dead reckoning, % | 10.0 ", text)
        self.assertIn("| published poses: median ratio | 0.200 |", text)
        self.assertIn("| maze | 3 | 1 | 33.3 | 6.1 to 79.2 | 1.010 | 1.500 |\n", text)
        self.assertIn("| offices | 17 | 0 | 0.0 | 0.0 to 18.4 | 0.100 | 0.100 |", text)

    def test_buildings_that_failed_are_named(self):
        built = [*buildings({}), rates.outcome(*runs.building_runs(30, 30), {"failed": "exit code 3: it broke"})]
        text = rates.buildings_text(built)
        self.assertIn("| – | 1 | 1 | 100.0 | 20.7 to 100.0 | – | – |", text)
        self.assertIn("Failed, seed (why): 30 (exit code 3: it broke).", text)
        self.assertIn("| median ratio to dead reckoning | – |", rates.buildings_text(built[-1:]))

    def test_the_worst_building_of_each_kind_is_pictured(self):
        built = buildings({2: (1.5, "maze"), 3: (2.0, "maze"), 4: (3.0, "wings"), 5: (1.01, "outdoors")})
        self.assertEqual([one.run.log.name for one in rates.pictured_buildings(built)], ["building 4", "building 3"])
        many = buildings({seed: (1.0 + seed, f"kind {seed}") for seed in range(1, 13)})
        self.assertEqual(len(rates.pictured_buildings(many)), 8)

    def test_robots_have_a_row_for_each_number_of_beams(self):
        text = rates.robots_text(robots({2: 0.6, 3: 1.5}))
        self.assertIn("| 4 | 10 | 1 | 10.0 | 1.8 to 40.4 | 0.100 | 1.500 | 1 | 0.200 | 3.000 |", text)
        self.assertIn("| 11 | 10 | 0 | 0.0 | 0.0 to 27.8 | 0.100 | 0.100 | 0 | 0.200 | 0.200 |", text)
        self.assertIn("| 61 | 10 | 0 | 0.0 | 0.0 to 27.8 | 0.100 | 0.600 | 1 | 0.200 | 1.200 |", text)
        self.assertIn("| offices | 30 | 1 |", text)
        self.assertIn("Over 1.02 times, seed (kind, beams, ratio): 3 (offices, 4 beams, 1.50).", text)

    def test_robots_that_fail_are_named(self):
        [robot] = robots({})[:1]
        text = rates.robots_text([rates.outcome(robot.run, {"failed": "exit code 3: it broke"})])
        self.assertIn("| 11 | 1 | 1 | 100.0 | 20.7 to 100.0 | – | – | 0 | – | – |", text)
        self.assertIn("Failed, seed (why): 1 (exit code 3: it broke).", text)

    def test_pictures_of_buildings_stand_beside_their_kinds(self):
        [one] = rates.pictured_buildings(buildings({3: (2.0, "maze")}))
        [log] = made([0.5])
        text = rates.document([log], [], [], [one], [], [("log.png", log), ("building_3.png", one)], PAGE)
        of_buildings, of_logs = text.split("## Simulated buildings")[1].split("## Pictures")
        self.assertIn("building 3, maze: error 2.000, 2.00 of dead reckoning.\n\n![map](robustness/building_3.png)",
                      of_buildings)
        self.assertIn("![map](robustness/log.png)", of_logs)
        self.assertNotIn("building_3", of_logs)

    def test_logs_as_they_are_have_a_column_for_each_number_of_beams(self):
        plain = [rates.outcome(one, result(1.0, 2.0 if one.beams == 4 else 0.5)) for one in runs.plain_runs()]
        text = rates.plain_table(plain)
        self.assertIn("| Robot 4 | 1.000 m, 0.50 | **1.000 m, 2.00** | **1.000 m, 2.00** |  |", text)
        self.assertIn("| Vicon, mean of 10 |  |  |  | 1.000 m (odometry 0.500) |", text)

    def test_relations_have_an_angle_too(self):
        relations = {"all": {"translation_m": {"mean": 0.05}, "rotation_deg": {"mean": 0.844}}}
        log = next(one for one in runs.plain_runs() if one.log.name == "FR079")
        one = rates.outcome(log, {**result(1.0, 2.0), "final": relations})
        self.assertIn("| FR079 | 0.050 m, 0.84 deg, 0.03 |", rates.plain_table([one]))

    def test_pieces_have_a_mean_and_those_with_motion_capture_a_row(self):
        pieces = [rates.outcome(one, result(1.0, 4.0) if one.log.name == "Vicon icp_d0" else result(2.0, 1.0))
                  for one in runs.piece_runs() if one.log.name in ("Robot 4", "Vicon icp_d0", "Vicon icp_d1")]
        pieces[-1] = rates.outcome(pieces[-1].run, {"failed": "it broke"})
        text = rates.pieces_table(pieces)
        self.assertIn("| Vicon | 12 | 0 | 0.707 | 6 | 2.00 |", text)
        self.assertIn("| Robot 4 | 6 | 1 | 2.000 | 5 | 2.00 |", text)
        self.assertIn("| **all** | 18 | 1 |", text)
        self.assertIn("| **all** | 0 | 0 | – | 0 | – |", rates.pieces_table([]))

    def test_the_page_has_all_parts_and_a_picture_of_each_break_out(self):
        group = made([0.1, 0.1, 0.1, 0.2, 0.9])
        pictured = rates.pictured(group, rates.Quarters(group))
        self.assertEqual([one.error for one in pictured], [0.9, 0.2])
        shown = list(zip(["robot_4.png", "robot_4_2.png"], pictured))
        text = rates.document(group, [], [], [], [], shown, PAGE)
        self.assertIn("commit abc", text)
        self.assertNotIn("Left out", text)
        self.assertIn("![map](robustness/robot_4.png)", text)
        self.assertIn("![map](robustness/robot_4_2.png)", text)
        self.assertNotIn("## Simulated buildings", text)
        self.assertNotIn("## Robots with wheels", text)
        self.assertIn("| **all** | 5 | 2 | 40.0 |", text)

    def test_the_page_says_what_its_figures_cannot_show(self):
        text = " ".join(rates.document(made([0.1]), [], [], [], [], [], PAGE).split())
        self.assertIn("A map that lays two corridors on each other covers fewer cells, so logs without truth (Duke "
                      "loop, Malaga, Mines 1, Mines 2, Mines 3, Mines 4, Olsson Hall, Rice Hall) do not show it.",
                      text)
        self.assertIn("Intervals are Wilson's, as of independent runs; those of the rows in bold are a bootstrap over "
                      "whole logs", text)

    def test_the_page_says_how_many_poses_motion_capture_has(self):
        flights = [ensemble.log for ensemble in runs.ENSEMBLES if ensemble.log.name.startswith("Vicon")][:3]
        real = [one for log in flights for one in made([0.1], beams=None, log=log)]
        with mock.patch.object(runs, "true_poses", lambda log: 9 if log == flights[1] else 16):
            text = rates.document(real, [], [], [], [], [], PAGE)
            self.assertIn("Each flight of Vicon has 9 to 16 true poses, at its stops.", text)
            self.assertNotIn("true poses", rates.document(made([0.1]), [], [], [], [], [], PAGE))

    def test_lines_are_not_too_long(self):
        built = buildings({seed: (1.0 + seed, "symmetrical") for seed in range(1, 20)})
        text = rates.document(made([0.1]), [], [], built, robots({3: 2.0}), [], PAGE)
        self.assertIn("## Robots with wheels", text)
        for line in text.splitlines():
            self.assertTrue(len(line) <= 120 or line.startswith("|"), line)

    def test_the_page_names_the_data_that_were_missing(self):
        text = rates.document(made([0.1]), [], [], [], [], [], {**PAGE, "missing": ["a.clf", "b.tum"]})
        self.assertIn("\nLeft out, for lack of data: a.clf; b.tum.\n", text)


if __name__ == "__main__":
    unittest.main()

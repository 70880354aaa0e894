#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/accuracy_sweeps.py tells the paper's shapes from others, and says which relations make the difference."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import accuracy_sweeps as sweeps  # noqa: E402

BEAMS, KERNEL, MULTISCAN = sweeps.SWEEPS


def band(count, translation_m):
    return {"count": count, "translation_m": {"mean": translation_m}}


def result(short_m, long_m, kept=10):
    """Three quarters of the relations are short, one quarter is long, none between."""
    return {"final": {"all": band(100, 0.75 * short_m + 0.25 * long_m), "under_3_s": band(75, short_m),
                      "from_3_to_100_s": {"count": 0, "translation_m": None}, "over_100_s": band(25, long_m)},
            "report": {"backend": {"closures": {"accepted": kept + 2, "dropped": 2}}}}


class AccuracySweeps(unittest.TestCase):
    def test_more_beams_must_help_and_the_first_ones_most(self):
        self.assertIsNone(sweeps.falls_ever_less({4: 0.12, 11: 0.09, 60: 0.08}))
        self.assertIn("no better at 60", sweeps.falls_ever_less({4: 0.12, 11: 0.09, 60: 0.12}))
        self.assertIn("worse at 9 than at 4", sweeps.falls_ever_less({4: 0.12, 9: 0.2, 11: 0.09, 60: 0.08}))
        self.assertIn("gains more from 11", sweeps.falls_ever_less({4: 0.12, 11: 0.11, 60: 0.08}))

    def test_the_kernel_of_three_must_be_best_and_wider_ones_ever_worse(self):
        self.assertIsNone(sweeps.least_at_three({1: 0.2, 3: 0.1, 5: 0.12, 7: 0.15}))
        self.assertIn("least at 1", sweeps.least_at_three({1: 0.09, 3: 0.1, 5: 0.12, 7: 0.15}))
        self.assertIn("beyond 3", sweeps.least_at_three({1: 0.2, 3: 0.1, 5: 0.15, 7: 0.12}))

    def test_a_sweet_spot_is_not_at_an_end(self):
        self.assertIsNone(sweeps.sweet_spot({92: 0.2, 100: 0.1, 132: 0.2}))
        self.assertIn("the end, 92", sweeps.sweet_spot({92: 0.1, 100: 0.2, 132: 0.3}))
        self.assertIn("the end, 132", sweeps.sweet_spot({92: 0.3, 100: 0.2, 132: 0.1}))

    def test_the_difference_belongs_to_the_relations_that_changed(self):
        shares = sweeps.shares_of_difference(result(0.03, 0.3)["final"], result(0.02, 0.1)["final"])
        self.assertAlmostEqual(shares["under 3 s"], 0.75 * 0.01 / (0.75 * 0.01 + 0.25 * 0.2))
        self.assertEqual(shares["of 3 to 100 s"], 0.0)
        self.assertAlmostEqual(sum(shares.values()), 1.0)

    def test_a_wrong_shape_comes_with_its_reason(self):
        text = sweeps.verdict(KERNEL, {1: result(0.02, 0.2, kept=90), 3: result(0.02, 0.3, kept=30),
                                       5: result(0.02, 0.31), 7: result(0.02, 0.32, kept=20)})
        for part in ("not the paper's shape", "least at 1", "From 7 to 1, 100%", "relations over 100 s",
                     "20 kept and 2 dropped at 7, 90 kept and 2 dropped at 1"):
            self.assertIn(part, text)

    def test_small_differences_are_called_flat(self):
        results = {value: result(0.02, 0.1 + 1e-5 * value) for value in MULTISCAN.values}
        self.assertTrue(sweeps.verdict(MULTISCAN, results).startswith("flat"))

    def test_a_setting_that_breaks_out_is_named_and_the_rest_judged_without_it(self):
        results = {value: result(0.02, 0.2 / value) for value in BEAMS.values}
        self.assertTrue(sweeps.verdict(BEAMS, results).startswith("the paper's shape"))
        text = sweeps.verdict(BEAMS, {**results, 9: result(0.02, 5.0)})
        self.assertTrue(text.startswith("**outlier** at 9 (1.26 m)."), text)
        self.assertIn("The others: the paper's shape", text)

    def test_no_kernel_at_all_may_break_out_for_the_paper_says_that_it_is_worse(self):
        text = sweeps.verdict(KERNEL, {1: result(0.02, 3.0, kept=1), 3: result(0.02, 0.1), 5: result(0.02, 0.12),
                                       7: result(0.02, 0.13)})
        self.assertTrue(text.startswith("the paper's shape, with an **outlier** at 1 (0.765 m)."), text)
        self.assertIn("1 kept and 2 dropped at 1", text)

    def test_a_break_out_elsewhere_is_never_part_of_the_paper_s_shape(self):
        results = {value: result(0.02, 0.1 + 0.001 * abs(value - 112)) for value in MULTISCAN.values}
        text = sweeps.verdict(MULTISCAN, {**results, 132: result(0.02, 5.0)})
        self.assertTrue(text.startswith("**outlier** at 132"), text)

    def test_break_outs_of_complete_curves_are_counted(self):
        broken = sweeps.runs.Run(sweeps.runs.INTEL, beams=9)
        made = {run: result(0.02, 5.0 if run == broken else 0.1) for run in sweeps.runs.PARTS["beams"]}
        self.assertEqual(sweeps.break_out_count(made.get), (1, 4 * len(BEAMS.values)))
        del made[broken]
        self.assertEqual(sweeps.break_out_count(made.get), (0, 3 * len(BEAMS.values)))

    def test_nothing_is_concluded_from_a_part_of_the_runs(self):
        self.assertIn("not all runs", sweeps.verdict(KERNEL, {1: result(0.02, 0.2)}))


if __name__ == "__main__":
    unittest.main()

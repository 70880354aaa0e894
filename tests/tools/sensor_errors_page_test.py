#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/sensor_errors_page.py writes down what each error of the sensors costs."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import sensor_errors_page as page  # noqa: E402
import sensor_errors_runs as wanted  # noqa: E402


def rows_of(by_error):
    """`by_error`: of each spared error the factor on the final errors of three buildings."""
    usual = {0: 0.5, 1: 0.1, 2: 2.06}
    return [(wanted.Run(seed, without), {"odometry": 2.0, "live": 1.0, "corrected": factor * error_m})
            for without, factor in by_error.items() for seed, error_m in usual.items()]


class SensorErrorsPage(unittest.TestCase):
    def test_an_error_costs_the_mean_of_the_ratios_building_by_building(self):
        lines = page.table(rows_of({"": 1.0, "floors": 0.5, "ranges,tilt,lag": 1.0})).splitlines()
        self.assertEqual(lines[2], "| none | 1 | 1 | 1 | 0.500 | 0.250 | 1.030 | 1 |")
        self.assertIn("| `floors` | 1.00 (1.00 to 1.00) | 1.00 (1.00 to 1.00) | 0.50 (0.50 to 0.50) |", lines[3])
        self.assertTrue(lines[3].endswith("| 0.250 | 0.125 | 0.515 | 0 |"), lines[3])
        self.assertIn("| all of the ranges (`ranges,tilt,lag`) |", lines[4])

    def test_what_the_truth_leads_to_stands_beside_the_map(self):
        rows = [(wanted.Run(seed, without), {"odometry_m": 2.0, "final_m": 0.5, "from_truth_m": 0.25,
                                             "on_true_walls_m": 0.2, "final_misfit": 10.0, "from_truth_misfit": misfit})
                for without in ("", "floors") for seed, misfit in ((0, 9.0), (1, 11.0), (2, 10.0))]
        self.assertEqual(page.table_from_truth(rows).splitlines()[-3:], [
            "| `floors` | as mapped | 0.250 | 0.250 | 0 |", "| `floors` | from the truth | 0.125 | 0.125 | 0 |",
            "| `floors` | from the truth, on true walls | 0.100 | 0.100 | 0 |"])
        self.assertEqual(page.preferred(rows), "1 of 3")
        self.assertEqual([run.without for run in wanted.runs_from_truth(range(1))], ["", "floors"])

    def test_the_interval_is_that_of_the_mean_logarithm(self):
        self.assertEqual(page.change({1: 1.0, 2: 4.0}, {1: 1.0, 2: 1.0}), "2.00 (0.51 to 7.78)")

    def test_each_building_is_mapped_with_all_errors_and_without_each(self):
        runs = wanted.all_runs(range(2))
        self.assertEqual(len(runs), 2 * (1 + len(wanted.ERRORS) + len(wanted.TOGETHER)))
        self.assertEqual(runs[1].title(), "sim://building?seed=1")
        self.assertEqual(wanted.Run(7, "floors,lag").title(), "sim://building?seed=7&without=floors,lag")

    def test_the_names_are_those_of_the_simulation(self):
        source = Path(__file__).parents[2] / "firmware_link/simulation/spared_errors.cpp"
        for name in wanted.ERRORS:
            self.assertIn(f'{{"{name}",', source.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()

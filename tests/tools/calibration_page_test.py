#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/calibration_page.py writes down what was found beside what is true."""

import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import calibration_page as page  # noqa: E402


def known(setting, true, found=None, sigma=None):
    return {"setting": f"sensor.{setting}", "true": true, "found": found, "sigma": sigma}


def flight(seed=1):
    return {"seed": seed, "min_age_s": 0.081, "max_age_s": 0.094,
            "figures": [known("range_age_s", 0.088, 0.096, 0.006),
                        known("odometry_forward_scale", 1.004, 0.992, 0.004),
                        known("odometry_sideways_scale", 0.99),
                        known("missed_yaw_per_metre_rad", 0.0),
                        known("missed_yaw_per_radian", 0.009, 0.007, 0.003),
                        known("missed_yaw_per_second_rad", math.radians(-0.06), math.radians(-0.04),
                              math.radians(0.02))]}


def finding(setting, verdict, value=None, sigma=None):
    return {"setting": f"sensor.{setting}", "verdict": verdict, "value": value, "sigma": sigma}


FINDINGS = [finding("range_age_s", "as_is", 0.089, 0.008), finding("odometry_forward_scale", "matters", 0.963, 0.003),
            finding("odometry_sideways_scale", "not_observable"), finding("missed_yaw_per_radian", "not_observable"),
            finding("missed_yaw_per_metre_rad", "learnt", math.radians(3.2), math.radians(0.05)),
            finding("missed_yaw_per_second_rad", "not_observable")]


def relations(metres, degrees):
    return {"final": {"all": {"translation_m": {"mean": metres}, "rotation_deg": {"mean": degrees}}}}


def office(name, live, final):
    return {"input": name, **{how: {"live": {"rmse_m": live * share}, "final": {"rmse_m": final * share}}
                              for how, share in (("without", 1.0), ("with", 0.5), ("default", 0.8))}}


LOG = {"input": "a log", "calibration": {"findings": FINDINGS, "check": None}, "without": relations(0.0298, 0.799),
       "with": relations(0.029, 0.796), "default": relations(0.0285, 0.79),
       "seconds": 29.6,
       "wheels": {"relations": 900, "scale": (0.98, 0.004), "missed_yaw_per_metre_rad": None}}
HALL = {"input": "a hall", "calibration": {"findings": FINDINGS, "check": {"held_out_before_m": 0.0638,
                                                                         "held_out_after_m": 0.0608}},
        "without": {"final": {"cells_20_cm": 1760}}, "with": {"final": {"cells_20_cm": 1630}},
        "default": {"final": {"cells_20_cm": 1700}}, "seconds": 4.2, "wheels": None}
REPORT = {"date": "2026-01-02", "commit": "abc", "machine": "a machine", "missing": [], "flights": [flight(1)],
          "others": [flight(11)], "offices": [office("one", 0.4, 0.2), office("two", 0.6, 0.1)], "logs": [LOG, HALL],
          "ages": [{"input": "a hall", "age_s": age_s, "final": {"cells_20_cm": cells}}
                   for age_s, cells in ((0.1, 1760), (0.0, 1900))]}


class CalibrationPage(unittest.TestCase):
    def test_a_flight_shows_the_truth_beside_what_was_found_and_what_was_not(self):
        self.assertIn("| 1 | 0.081 to 0.094 | 0.088 / 0.096 ± 0.006 | 1.004 / 0.992 ± 0.004 | 0.990 / – | "
                      "+0.009 / +0.007 ± 0.003 | -0.06 / -0.04 ± 0.02 |", page.flights_table([flight()]))

    def test_says_how_many_figures_agree_and_which_is_farthest_off(self):
        self.assertEqual(" ".join(page.agreement([flight(1)]).split()),
                         "Of 4 figures found, 3 lie within 2 standard deviations of the true one. Farthest off is the "
                         "forward scale of seed 1, by 3.0.")

    def test_flights_are_averaged(self):
        self.assertIn("| mean | 0.500 | 0.250 | 0.400 | 0.150 | 0.075 | 0.120 |", page.offices_table(REPORT["offices"]))

    def test_gains_are_held_against_no_estimate_at_all_and_against_the_program_as_it_runs(self):
        for table in (page.offices_table(REPORT["offices"]), page.gains_table([LOG])):
            heading = table.splitlines()[0]
            self.assertIn("`--no-calibrate`", heading)
            self.assertIn("by default", heading)
        self.assertIn("`--no-calibrate`", page.tables(REPORT).split("## The age alone")[1])

    def test_what_matters_is_bold_and_what_is_learnt_says_so(self):
        self.assertIn("| a log | 0.089 ± 0.008 | **0.963 ± 0.003** | – | – | +3.20 ± 0.05, learnt | – | 30 |",
                      page.findings_table([LOG]))

    def test_gains_are_told_by_what_there_is_to_judge_by(self):
        table = page.gains_table([LOG, HALL])
        self.assertIn("| a log | – | – | 0.0298 m, 0.799 deg | 0.0290 m, 0.796 deg | "
                      "0.0285 m, 0.790 deg |", table)
        self.assertIn("| a hall | 63.8 mm | 60.8 mm | 1760 cells | 1630 cells | 1700 cells |", table)

    def test_wheels_are_told_of_logs_only(self):
        text = page.wheels_text([LOG, HALL])
        self.assertIn("| a log | 900 | 0.980 ± 0.004 | – |", text)
        self.assertNotIn("a hall", text)
        self.assertEqual(page.wheels_text([HALL]), "")

    def test_ages_stand_in_order(self):
        self.assertEqual(page.ages_table(REPORT["ages"]).splitlines()[0::2],
                         ["| input | 0 s | 0.1 s |", "| a hall | 1900 cells | 1760 cells |"])

    def test_the_page_tells_its_circumstances_and_what_was_left_out(self):
        text = page.document({**REPORT, "logs": [], "ages": [], "missing": ["a.pcap", "b.clf"]})
        self.assertIn("`tools/benchmark-calibration --record` on 2026-01-02, commit abc", text)
        self.assertIn("for lack of data: a.pcap; b.clf.", text)
        self.assertNotIn("## Recorded inputs", text)
        self.assertIn("## Recorded inputs", page.document(REPORT))


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/accuracy_page.py holds figures against the right limits and leaves out what was not measured."""

import sys
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import accuracy_page as page  # noqa: E402
import accuracy_runs as runs  # noqa: E402
import mapped_runs  # noqa: E402


def judged(translation_m, rotation_deg):
    return {"all": {"translation_m": {"mean": translation_m, "std": 0.01},
                    "rotation_deg": {"mean": rotation_deg, "std": 0.1}}}


def laser_result(translation_m, rotation_deg, live=None):
    return {"final": judged(translation_m, rotation_deg), "live": live, "odometry": judged(1.0, 10.0)}


def flight_result(cells):
    return {which: {"cells_20_cm": cells} for which in ("odometry", "live", "final")}


class AccuracyPage(unittest.TestCase):
    def missed(self, made):
        return page.missed(page.rows_of(made.get))

    def test_without_refinement_the_paper_s_code_is_the_limit_with_it_a_lower_one(self):
        plain, refined = runs.both(log=runs.ACES, beams=11)
        made = {plain: laser_result(0.0454, 1.0), refined: laser_result(0.0454, 0.5)}
        self.assertEqual(self.missed(made), ["ACES, 11 beams, refined: 0.0454 m, limit 0.036 m"])
        self.assertEqual(page.limits_count(page.rows_of(made.get)), 4)
        text = page.tables(page.rows_of(made.get))
        self.assertIn("| 0.0454 ± 0.0100 | met | 1.000 ± 0.100 | met |", text)
        self.assertIn("| 0.0454 ± 0.0100 | **missed** | 0.500 ± 0.100 | met |", text)

    def test_what_has_no_limit_is_neither_met_nor_missed(self):
        plain, refined = runs.both(log=runs.KILLIAN, beams=4)
        made = {plain: laser_result(40.0, 18.0), refined: laser_result(0.1, 18.0)}
        self.assertEqual(self.missed(made), [])
        self.assertEqual(page.limits_count(page.rows_of(made.get)), 1)
        self.assertIn("| – | – | 40.0000 ± 0.0100 |  | 18.000 ± 0.100 |  |", page.tables(page.rows_of(made.get)))

    def test_live_figures_stand_beside_the_final_ones_where_there_are_any(self):
        run = runs.Run(runs.INTEL, beams=11)
        with_live = {run: laser_result(0.04, 1.0, live=judged(0.08, 2.0))}
        self.assertIn("| 0.0800 / 2.000 | 1.0000 / 10.000 |", page.tables(page.rows_of(with_live.get)))
        self.assertEqual(page.live_note(page.rows_of(with_live.get)), "")
        without = {run: laser_result(0.04, 1.0)}
        self.assertIn("| – | 1.0000 / 10.000 |", page.tables(page.rows_of(without.get)))
        self.assertIn("no `live.tum`", page.live_note(page.rows_of(without.get)))

    def test_flights_are_held_against_cells(self):
        made = {runs.Run(runs.OLSSON): flight_result(1800), runs.Run(runs.RICE): flight_result(1721)}
        self.assertEqual(self.missed(made), ["Rice Hall: 1721 cells, limit 1720"])

    def test_a_page_without_sweeps_says_so(self):
        class Nothing:
            program = "0"

            @staticmethod
            def get(_):
                return None

        with mock.patch.object(mapped_runs, "DATASETS", Path("/no/such/folder")):
            text = page.document(Nothing, {"date": "d", "commit": "c", "machine": "m"})
        self.assertEqual(text.count(page.NOT_MADE), len(runs.PARTS))
        self.assertIn("missing: `radish/aces.clf.gz`", text)


if __name__ == "__main__":
    unittest.main()

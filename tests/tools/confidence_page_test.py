#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/confidence_page.py writes down what the program says of its own poses."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import confidence_page as page  # noqa: E402
import confidence_runs as runs  # noqa: E402


def result(hours=1.0, **figures):
    return {"after": [], "seconds": 3600 * hours, "seconds_doubted": 36.0, "alarms": 0, "false_alarms": 0,
            "unjudged_alarms": 0, "times_off": 0, "noticed_s": [], **figures}


def rows_of(threshold=None):
    """Two buildings, one office and its faults."""
    return [*((runs.simulated(f"building?seed={seed}", "building", threshold),
               result(alarms=4, false_alarms=1, unjudged_alarms=2)) for seed in (1000, 1001)),
            (runs.simulated("office?seed=1", "healthy", threshold), result(2.0, alarms=1, false_alarms=1)),
            *((runs.simulated(f"office?seed=1&fault={fault.text()}", fault.text(), threshold),
               result(times_off=2, noticed_s=[1.0])) for fault in runs.FAULTS)]


def document(rows, missing=()):
    return page.document({"date": "2026-01-02", "commit": "abc", "machine": "a machine", "default": 19.6,
                          "rows": rows, "missing": list(missing)})


class ConfidencePage(unittest.TestCase):
    def test_alarms_that_nobody_can_judge_have_a_column(self):
        lines = page.alarm_table(rows_of()).splitlines()
        self.assertIn("| alarms | false | not known | false an hour |", lines[0])
        self.assertIn("| buildings | 2.0 | 8 | 2 | 4 | 1.00 | 1.0 % |", lines[2])
        self.assertIn("| all of them | 4.0 | 9 | 3 | 4 | 0.75 | 0.8 % |", lines[-1])

    def test_the_rate_of_buildings_stands_beside_that_of_all(self):
        text = page.alarm_summary(rows_of())
        self.assertIn("False alarms an hour: 0.75 of all flights, 1.00 of buildings alone", text)
        self.assertIn("at most 1.75 and 3.00 if all that are not known were false", " ".join(text.split()))

    def test_the_threshold_tells_of_which_runs_it_is(self):
        text = page.tables({"rows": [*rows_of(), *rows_of(10.0), (runs.simulated("loop?seed=1", "healthy"), result())],
                            "default": 19.6})
        self.assertIn('"False an hour" is of flights without a fault (building: 2, office: 1), the rest of those with '
                      'one above (4).', text)
        self.assertIn("| 10 | 0.75 | 8 | 50 % | 50 % |", text)

    def test_the_page_names_the_data_that_were_missing(self):
        rows = [*rows_of(), *rows_of(10.0)]
        self.assertIn("Left out, for lack of data: a.pcap; b.pcap.", document(rows, ["a.pcap", "b.pcap"]))
        self.assertNotIn("Left out", document(rows))

    def test_the_page_says_that_worlds_drawn_by_hand_are_easier(self):
        self.assertIn("have an easier sensor", document([*rows_of(), *rows_of(10.0)]))


if __name__ == "__main__":
    unittest.main()

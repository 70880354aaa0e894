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
    def test_the_page_names_the_data_that_were_missing(self):
        self.assertIn("Left out, for lack of data: a.pcap; b.pcap.", document([*rows_of(), *rows_of(10.0)], ["a.pcap", "b.pcap"]))
        self.assertNotIn("Left out", document([*rows_of(), *rows_of(10.0)]))


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/accuracy_changes.py holds changed copies against the log as it is."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import accuracy_changes as changes  # noqa: E402
import accuracy_runs as runs  # noqa: E402

BACKWARDS, MIRRORED = runs.CHANGES[:2]


def result(translation_m):
    return {"final": {"all": {"translation_m": {"mean": translation_m}, "rotation_deg": {"mean": 1.0}}}}


def made(errors):
    """ACES with 4 beams, errors by change."""
    return {runs.Run(runs.ACES, beams=4, change=change): result(error) for change, error in errors.items()}.get


class AccuracyChanges(unittest.TestCase):
    def test_a_copy_stands_out_with_half_as_much_again_as_the_log_as_it_is(self):
        text = changes.text(made({None: 0.04, BACKWARDS: 0.07, MIRRORED: 0.05}))
        self.assertIn("| m / deg | ACES, 4 |", text)
        self.assertIn("| as it is | 0.0400 / 1.00 |", text)
        self.assertIn("| backwards | **0.0700 / 1.00** |", text)
        self.assertIn("| mirrored | 0.0500 / 1.00 |", text)
        self.assertIn("1 of 2.", text)

    def test_a_copy_stands_out_from_nothing_where_the_log_itself_was_not_mapped(self):
        text = changes.text(made({BACKWARDS: 7.0}))
        self.assertIn("| backwards | 7.0000 / 1.00 |", text)
        self.assertIn("0 of 1.", text)

    def test_without_any_run_there_is_no_section(self):
        self.assertEqual(changes.text({}.get), "")


if __name__ == "__main__":
    unittest.main()

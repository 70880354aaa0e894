#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/tuning_page.py holds each constant against the default: islands, and what changes nothing."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import robustness_runs  # noqa: E402
import tuning_page as page  # noqa: E402
import tuning_runs as runs  # noqa: E402

CONSTANTS = [runs.Constant("part", key, "2.0", 0.02, 200.0, f"what {key} is")
             for key in ("calm", "idle", "steep", "new")]
ENSEMBLE = robustness_runs.building_runs(0, 9)
VARIANTS = runs.variants_of(CONSTANTS)
REPORT = {"mean_per_scan_ms": 0.2}


def result(error, digest):
    return {"final": {"rmse_m": error}, "odometry": {"rmse_m": 1.0}, "report": REPORT, "at_once": 1, "digest": digest}


def get(run):
    """calm: errors grow a little. idle: nothing changes. steep: one building breaks out. new: was not run."""
    if "new" in run.settings:
        return None
    if "calm" in run.settings:
        return result(0.11, "other")
    if "steep = 4.0" in run.settings and run.log.name == "building 3":
        return result(1.1, "other")
    return result(0.1, "same")


class TuningPage(unittest.TestCase):
    def setUp(self):
        self.default = page.yardstick(ENSEMBLE, get)
        self.swept = page.swept(VARIANTS, ENSEMBLE, self.default, get)

    def test_constants_are_sorted_and_those_without_runs_left_out(self):
        self.assertEqual([one.constant.key for one in self.swept], ["steep", "calm", "idle"])

    def test_an_island_breaks_runs_at_half_or_double(self):
        self.assertEqual([one.is_island() for one in self.swept], [True, False, False])
        effect = self.swept[0].effects[page.DOUBLE]
        self.assertEqual((effect.out, effect.broken, effect.mended), (1, 1, 0))
        self.assertAlmostEqual(self.swept[1].effects[page.HALF].error, 1.1)

    def test_a_run_that_is_mended_hides_none_that_breaks(self):
        def trades(run):
            breaks = "building 3" if "calm" in run.settings else "building 5"
            return result(1.1 if run.log.name == breaks else 0.1, breaks)

        default = page.yardstick(ENSEMBLE, trades)
        [calm] = page.swept(runs.variants_of(CONSTANTS[:1]), ENSEMBLE, default, trades)
        self.assertTrue(calm.is_island())
        self.assertIn("**10.0 (+1 -1)**", page.body([calm], default))

    def test_what_changes_no_byte_stands_apart(self):
        self.assertEqual([one.changes_nothing() for one in self.swept], [False, False, True])
        text = page.body(self.swept, self.default)
        self.assertIn("3 constants: 1 islands, 1 that change nothing. With the defaults 0 of 10", text)
        self.assertIn("| **`part.steep`** | 2.0 | what steep is | 1.0 | 0.0 (+0 -0) | 1.000 | 0.100 | 4.0 "
                      "| **10.0 (+1 -0)** |", text)
        self.assertIn("Neither half nor double changes a byte of any output.", text)
        self.assertIn("| `part.idle` | 2.0 | what idle is |", text)

    def test_a_run_that_fails_breaks_out(self):
        def fails(run):
            return {"failed": "exit code 2: refused"} if "calm" in run.settings else get(run)

        [calm] = page.swept(runs.variants_of(CONSTANTS[:1]), ENSEMBLE, self.default, fails)
        self.assertEqual(calm.effects[page.HALF].out, 10)
        self.assertIn("100.0 (+10 -0)", page.body([calm], self.default))

    def test_nothing_is_compared_without_the_default(self):
        with self.assertRaises(LookupError):
            page.yardstick(ENSEMBLE, lambda run: None)

    def test_the_page_says_what_it_was_made_of(self):
        text = page.document(self.swept, self.default, 10, {"date": "2026-11-22", "commit": "abc", "machine": "some"})
        self.assertIn("10 simulated buildings and 0 short real runs", text)
        self.assertIn("commit abc", text)

    def test_the_page_says_what_breaks_out(self):
        text = " ".join(page.document(self.swept, self.default, 10, {"date": "", "commit": "", "machine": ""}).split())
        self.assertIn("exceeds that of dead reckoning by more than 2 %", text)
        self.assertIn("Each log has one real run, whose error is its own best quarter: with the defaults it breaks out "
                      "only by dead reckoning, or by an error known to be attainable.", text)


if __name__ == "__main__":
    unittest.main()

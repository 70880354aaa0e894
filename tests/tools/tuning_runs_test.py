#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/tuning_runs.py reads the constants and where they come from, and halves and doubles them within their range."""

import collections
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tools"))
sys.dont_write_bytecode = True
import tuning_runs as runs  # noqa: E402

HEADER = """
struct GroupTuning {
  double reach_m = 30.0;          ///< travel over which a match waits ...
  std::size_t max_waiting = 100;  ///< ... while there are no more
  double share =
      0.6;  ///< of the points, or there is
            ///< no match
  int rounds = 1;

  static constexpr TuningValue<GroupTuning> kValues[] = {
      {"reach_m", &GroupTuning::reach_m},
      {"max_waiting",
       &GroupTuning::max_waiting},
      {"share", &GroupTuning::share}, {"rounds", &GroupTuning::rounds}};
};
struct Other {
  double reach_m = 1.0;
};
"""
PRINTED = """[tuning.groups]
reach_m = 30.0  # 0.3 to 3000
max_waiting = 3  # 1 to 300
share = 0.6  # 0.006 to 1
rounds = 1  # 1 to 100
"""


class TuningRuns(unittest.TestCase):
    def constants(self):
        return {one.key: one for one in runs.constants_of(PRINTED, runs.origins_of(HEADER))}

    def test_constants_have_the_comments_of_their_struct(self):
        self.assertEqual({key: one.origin for key, one in self.constants().items()},
                         {"reach_m": "travel over which a match waits ...",
                          "max_waiting": "... while there are no more",
                          "share": "of the points, or there is no match", "rounds": ""})

    def test_values_are_halved_and_doubled_within_their_range(self):
        changed = {key: (one.times(0.5), one.times(2.0)) for key, one in self.constants().items()}
        self.assertEqual(changed, {"reach_m": ("15.0", "60.0"), "max_waiting": ("2", "6"), "share": ("0.3", "1.0"),
                                   "rounds": (None, "2")})
        variants = runs.variants_of(self.constants().values())
        self.assertEqual(len(variants), 7)
        self.assertEqual(variants[0].settings(), "[tuning.groups]\nreach_m = 15.0\n")

    def test_what_is_no_constant_is_refused(self):
        with self.assertRaisesRegex(ValueError, "'reach_m = 30'"):
            runs.constants_of("[tuning.groups]\nreach_m = 30\n", {})

    def test_each_struct_of_core_is_found(self):
        origins = runs.all_origins(ROOT / "core")
        self.assertGreater(sum(map(len, origins)), 100)
        for keys in origins:
            self.assertTrue(keys)

    def test_the_ensemble_has_buildings_and_a_run_of_each_log(self):
        drawn = runs.screening_ensemble(5)
        logs = collections.Counter(run.log.name for run in drawn)
        self.assertEqual(sum(name.startswith("building") for name in logs), 5)
        self.assertIn("Killian", logs)
        self.assertEqual(max(logs.values()), 1)


if __name__ == "__main__":
    unittest.main()

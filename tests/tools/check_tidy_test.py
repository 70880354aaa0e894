#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/check_tidy.py looks at what changed and, commit by commit, at all the rest."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import check_tidy  # noqa: E402

SOURCES = [f"core/{letter}.cpp" for letter in "abcdefghij"]


class CheckTidy(unittest.TestCase):
    def test_a_changed_header_stands_for_the_source_of_its_name(self):
        changed = check_tidy.sources_of(["core/a.hpp", "core/b.cpp", "core/only.hpp", "core/c.py", "README.md"], SOURCES)
        self.assertEqual(changed, ["core/a.cpp", "core/b.cpp"])

    def test_few_changes_are_all_looked_at(self):
        paths = check_tidy.choose(SOURCES, SOURCES[:2], "seed", most=3, few=2)
        self.assertEqual(set(paths[:2]), set(SOURCES[:2]))
        self.assertEqual(len(paths), 4)
        self.assertEqual(len(set(paths)), 4)

    def test_many_changes_are_cut_short(self):
        self.assertEqual(len(check_tidy.choose(SOURCES, SOURCES, "seed", most=3, few=2)), 3)

    def test_one_commit_gives_one_choice_and_many_reach_everything(self):
        self.assertEqual(check_tidy.choose(SOURCES, [], "seed"), check_tidy.choose(SOURCES, [], "seed"))
        reached = {path for seed in range(60) for path in check_tidy.choose(SOURCES, [], seed, few=2)}
        self.assertEqual(reached, set(SOURCES))


if __name__ == "__main__":
    sys.exit(unittest.main())

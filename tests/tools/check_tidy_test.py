#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/check_tidy.py looks at what changed most."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import check_tidy  # noqa: E402

SOURCES = {"core/a.cpp", "core/b.cpp", "core/c.cpp"}


class CheckTidy(unittest.TestCase):
    def test_a_changed_header_stands_for_the_source_of_its_name(self):
        numstat = ["1\t2\tcore/a.hpp", "30\t0\tcore/a.cpp", "4\t5\tcore/b.hpp", "6\t0\tcore/only.hpp", "7\t0\tcore/c.py",
                   "-\t-\tdocs/picture.png", "0\t9\tcore/deleted.cpp"]
        self.assertEqual(check_tidy.changed_lines(numstat, SOURCES), {"core/a.cpp": 33, "core/b.cpp": 9})

    def test_few_changes_are_all_looked_at(self):
        self.assertEqual(check_tidy.most_changed({"core/a.cpp": 1, "core/b.cpp": 2}, most=2), ["core/b.cpp", "core/a.cpp"])

    def test_of_many_the_most_changed_are_looked_at(self):
        lines = {"core/c.cpp": 5, "core/b.cpp": 5, "core/a.cpp": 1}
        self.assertEqual(check_tidy.most_changed(lines, most=1), ["core/b.cpp"])

    def test_nothing_changed_is_nothing_to_look_at(self):
        self.assertEqual(check_tidy.most_changed({}), [])


if __name__ == "__main__":
    sys.exit(unittest.main())

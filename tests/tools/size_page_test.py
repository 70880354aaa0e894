#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/size_page.py parses the output of binutils and of our own programs, and keeps to its section of the page."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import size_page  # noqa: E402

SIZE = """   text\t   data\t    bss\t    dec\t    hex\tfilename
   1000\t     10\t      1\t   1011\t    3f3\ta.o (ex liba.a)
   2000\t     20\t      2\t   2022\t    7e6\tb.o (ex liba.a)
   3000\t     30\t      3\t   3033\t    bd9\t(TOTALS)
"""
NM = """0000000000001000 0000000000000008 b swiftlet::(anonymous namespace)::count
0000000000001010 0000000000000010 V vtable for swiftlet::Link
0000000000001020 0000000000000020 d swiftlet::Extractor::resolve(swiftlet::Slots&) const::kRows
0000000000001040 0000000000000100 T main
"""
REPORT = {
    "date": "2026-11-22", "commit": "abc1234", "machine": "2-core x86_64 with Debian 12",
    "code": [("swiftletd", [3000, 30, 3]), ("core/backend", [1000, 10, 1])],
    "objects": [("swiftlet::kRows", 32)], "parts": [("frontend", 995336)], "missing": ["Rice Hall"],
    "stacks": [("simulated office", {"radio": (6300, 40000), "signals": (3000, 36700)})],
    "above": 33700, "peaks": [("simulated office", 3 * 1024 * 1024)],
}


class SizePage(unittest.TestCase):
    def test_of_several_files_the_sum_is_taken(self):
        self.assertEqual(size_page.sizes(SIZE), [3000, 30, 3])

    def test_static_objects_are_data_alone_and_the_largest_first(self):
        self.assertEqual(size_page.static_objects(NM), [("swiftlet::Extractor::resolve::kRows", 32), ("swiftlet::count", 8)])

    def test_a_part_is_its_own_bytes_and_those_on_the_heap(self):
        self.assertEqual(size_page.fixed_parts("frontend\t8\t992\nqueues\t500\t0\n"),
                         [("frontend", 1000), ("queues", 500)])

    def test_of_threads_with_one_name_the_deepest_counts(self):
        depths = size_page.stack_depths("radio\t100\t300\t8000\nradio\t200\t400\t8000\nbackend\t50\t250\t8000\n")
        self.assertEqual(depths, {"radio": (200, 400), "backend": (50, 250)})
        self.assertEqual(size_page.above_first_frame([("an input", depths)]), 200)

    def test_the_section_has_the_figures_of_each_table(self):
        text = size_page.section(REPORT)
        self.assertTrue(text.startswith(size_page.HEADING + "\n"))
        for line in ("| swiftletd | 3.0 | 0.0 | 0.0 |", "| `swiftlet::kRows` | 32 |", "| frontend | 995.3 |",
                     "| simulated office | 6.3 |  |  |  |  |", "| simulated office | 3.0 |",
                     "Not run, for lack of data: Rice Hall."):
            self.assertIn(line, text)

    def test_the_section_is_replaced_where_it_stands_and_nothing_else_is(self):
        new = size_page.HEADING + "\n\nnew\n"
        before, after = "# Real time\n\n## Figures\n\nold\n", "## Cross builds\n\nkept\n"
        old = size_page.HEADING + "\n\nold\n\n"
        self.assertEqual(size_page.with_section(before + "\n" + old + after, new), before + "\n" + new + "\n" + after)
        self.assertEqual(size_page.with_section(before + "\n" + old, new), before + "\n" + new)
        self.assertEqual(size_page.with_section(before, new), before + "\n" + new)


if __name__ == "__main__":
    unittest.main()

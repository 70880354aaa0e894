#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/instruction_counts.py sums calls in a profile by stage and tells what is off."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import instruction_counts as instructions  # noqa: E402

# Names are written once and numbered, callers of one function are several, and what a function costs by itself is in
# the costs of its calls.
PROFILE = """# callgrind format
events: Ir

fl=(1) map_command.cpp
fn=(1) main
10 7
cfn=(2) swiftlet::Backend::add(swiftlet::FrontendStep const&)
calls=3 20
11 300
cob=(4) libm.so
cfi=(5) s_sin.c
cfn=(3) sin
calls=1 0
12 9

fn=(2)
20 100
cfn=(3)
calls=2 0
+1 40

fn=(4) other
30 1
cfn=(2)
calls=1 20
* 50
"""


def counts(**changed):
    names = {instructions.TOTAL: 5000, **dict.fromkeys([*instructions.STAGES, *instructions.PARTS], 1000)}
    return {**names, **changed}


class InstructionCounts(unittest.TestCase):
    def test_a_function_costs_what_all_its_calls_cost(self):
        self.assertEqual(instructions.inclusive_costs(PROFILE.splitlines()),
                         {"swiftlet::Backend::add(swiftlet::FrontendStep const&)": 350, "sin": 49})

    def profile_of(self, *extra):
        functions = [name for names in {**instructions.STAGES, **instructions.PARTS}.values() for name in names]
        lines = ["fn=(0) main"]
        for i, name in enumerate([*functions, *extra], start=1):
            lines += [f"cfn=({i}) swiftlet::{name}" + ("int)" if name.endswith("(") else ""), "calls=1 0", f"0 {10**i}"]
        return lines

    def test_the_total_has_every_stage_once_and_no_part(self):
        counted = instructions.counts_of(self.profile_of("Backend::add(int)::{lambda()#1}::operator()"))
        self.assertEqual(counted["decoding"], 10)
        self.assertEqual(counted["map"], 10**5)
        self.assertEqual(counted["online refinement"], 10**9)
        self.assertEqual(counted[instructions.TOTAL], sum(10**i for i in range(1, 6)))

    def test_a_function_that_is_gone_or_has_a_namesake_is_named(self):
        for profile in (self.profile_of()[:-3], self.profile_of("OnlineRefinement::step(char)")):
            with self.assertRaisesRegex(instructions.Unusable, r"online refinement.*OnlineRefinement::step\("):
                instructions.counts_of(profile)

    def test_slower_and_faster_are_told_beyond_the_tolerance_alone(self):
        self.assertEqual(instructions.beyond_tolerance(
            counts(), counts(backend=1030, frontend=970, map=1019, decoding=981), tolerance_percent=2.0),
            ["frontend: faster: 970 instructions, baseline 1,000: -3.0 %, tolerance 2 %",
             "backend: slower: 1,030 instructions, baseline 1,000: +3.0 %, tolerance 2 %"])

    def test_what_differs_is_named_on_both_sides(self):
        self.assertEqual(instructions.differences({"a": "1", "b": "2", "c": "3"}, {"a": "1", "b": "4", "d": "5"}),
                         "b 2, now 4; c 3, now nothing; d nothing, now 5")

    def test_a_baseline_that_is_none_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "baseline.json")
            for text in ("", "[]", "{}", '{"instructions": {}, "build": {}, "packages": {}, "tolerance_percent": 2}'):
                path.write_text(text)
                with self.assertRaisesRegex(instructions.Unusable, "no baseline"):
                    instructions.load_baseline(path)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/benchmark-instructions, with a valgrind that answers at once: what it says, and its exit codes."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(__file__).parents[2] / "tools"
sys.path.insert(0, str(TOOLS))
sys.dont_write_bytecode = True
import instruction_counts as instructions  # noqa: E402

BUILD = {"compiler": "GNU 12.2.0", "flags": "-O2", "processor": "x86_64"}


class BenchmarkInstructions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.baseline = self.folder / "baseline.json"
        self.put_program("tools/swiftlet", "exit 0")
        self.put_program("valgrind", f'cp {self.folder}/profile profile; echo "$GLIBC_TUNABLES" > {self.folder}/tunables')
        self.put("tests/benchmarks/counted_build.json", json.dumps(BUILD))
        self.put_costs({})
        self.assertEqual(self.run_tool("--record").returncode, 0)

    def put(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def put_program(self, name, what):
        self.put(name, f"#!/bin/sh\n{what}\n").chmod(0o755)

    def put_costs(self, changed):
        """What the next run costs: 1000 a stage and part, but for those in `changed`."""
        lines = ["fn=(0) main"]
        for stage, functions in {**instructions.STAGES, **instructions.PARTS}.items():
            for name in functions:
                lines += [f"cfn=({len(lines)}) swiftlet::{name}", "calls=1 0", f"0 {changed.get(stage, 1000)}"]
        self.put("profile", "\n".join(lines) + "\n")

    def run_tool(self, *options):
        return subprocess.run(
            [sys.executable, TOOLS / "benchmark-instructions", "--build", self.folder, "--baseline", self.baseline,
             *options], capture_output=True, text=True, check=False,
            env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}", "PYTHONDONTWRITEBYTECODE": "1"})

    def expect_refusal(self, *words):
        done = self.run_tool()
        self.assertEqual(done.returncode, 2)
        [line] = done.stderr.splitlines()
        for word in words:
            self.assertIn(word, line)

    def test_the_recorded_counts_repeat(self):
        done = self.run_tool()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("-AVX2", (self.folder / "tunables").read_text())

    def test_a_slowdown_is_told_with_the_way_to_accept_it(self):
        self.put_costs({"frontend": 1021, "decoding": 1019})
        done = self.run_tool()
        self.assertEqual(done.returncode, 1)
        [slowdown, accept] = done.stderr.splitlines()
        self.assertIn("frontend: slower: 1,021 instructions, baseline 1,000: +2.1 %, tolerance 2 %", slowdown)
        self.assertIn("tools/benchmark-instructions --record", accept)
        self.assertEqual(self.run_tool("--record").returncode, 0)
        self.assertEqual(self.run_tool().returncode, 0)

    def test_a_gain_is_to_be_recorded_too(self):
        self.put_costs({"loop detection": 900})
        done = self.run_tool()
        self.assertEqual(done.returncode, 1)
        self.assertIn("loop detection: faster", done.stderr)

    def test_other_packages_are_named_beside_a_slowdown(self):
        kept = json.loads(self.baseline.read_text())
        self.baseline.write_text(json.dumps({**kept, "packages": {"libc6": "2.0"}}))
        self.put_costs({"frontend": 1100})
        self.assertIn("libc6 2.0, now", self.run_tool().stderr)

    def test_recording_keeps_the_tolerance(self):
        kept = json.loads(self.baseline.read_text())
        self.baseline.write_text(json.dumps({**kept, "tolerance_percent": 5}))
        self.put_costs({"frontend": 1100})
        self.run_tool("--record")
        kept = json.loads(self.baseline.read_text())
        self.assertEqual((kept["tolerance_percent"], kept["instructions"]["frontend"]), (5, 1100))

    def test_the_figures_of_another_compiler_are_not_compared(self):
        self.put_costs({"frontend": 5000})
        self.put("tests/benchmarks/counted_build.json", json.dumps({**BUILD, "compiler": "Clang 14.0.6"}))
        done = self.run_tool()
        self.assertEqual(done.returncode, 77)
        self.assertIn("compiler GNU 12.2.0, now Clang 14.0.6", done.stdout)

    def test_a_bad_baseline_is_one_line_and_exit_code_2(self):
        self.baseline.write_text("{")
        self.expect_refusal("baseline.json: no baseline")
        self.baseline.unlink()
        self.expect_refusal("baseline.json: no baseline")

    def test_a_baseline_of_another_flight_is_refused(self):
        kept = json.loads(self.baseline.read_text())
        self.baseline.write_text(json.dumps({**kept, "flight": "sim://maze"}))
        self.expect_refusal("another flight", "sim://maze")

    def test_what_swiftlet_refuses_is_told_with_its_words(self):
        self.put_program("tools/swiftlet", "echo 'swiftlet: no such world' >&2; exit 2")
        self.expect_refusal("swiftlet: exit code 2: swiftlet: no such world")

    def test_a_build_that_is_not_there_is_refused(self):
        (self.folder / "tests/benchmarks/counted_build.json").unlink()
        self.expect_refusal("counted_build.json")


if __name__ == "__main__":
    unittest.main()

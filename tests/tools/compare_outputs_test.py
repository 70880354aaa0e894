#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/compare-outputs, with programs that answer at once: what it calls a difference, and its exit codes."""

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
import compared_runs as runs  # noqa: E402
import output_differences as differences  # noqa: E402

# Stands in for swiftlet: counts its calls and copies the files beside it to out/, with its configuration.
PRETENDS = """#!/bin/sh
echo "$@" >> "$0.calls"
cp -r "$0.files/." out
[ -e settings.toml ] && cp settings.toml "$0.toml"
cat "$0.stdout"
echo "a word on stderr" >&2
exit $(cat "$0.exit")
"""
TRAJECTORY = "1.0 0.0 0.0 0 0 0 0 1\n2.0 1.0 0.0 0 0 0 0 1\n3.0 2.0 0.0 0 0 0 0 1\n"
REPORT = {"backend": {"scans": 3, "closures": {"tried": 2}}, "stage_times": {"map": {"max_ms": 2.5}},
          "peak_memory_mb": 20.5, "input": {"notes": ["a note"]}}


class CompareOutputs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "data/flights").mkdir(parents=True)
        (self.folder / "data/flights/rice.pcap").write_text("a flight")
        self.old, self.new = self.put_program("old"), self.put_program("new")

    def put_program(self, name, report=None, exit_code=0, stdout="", **files):
        """`files`: instead of what both write, by the names without dots."""
        program = self.folder / name
        program.write_text(PRETENDS + f"# {name}\n")
        program.chmod(0o755)
        written = Path(f"{program}.files")
        written.mkdir(exist_ok=True)
        (written / "trajectory.tum").write_text(files.get("trajectory", TRAJECTORY))
        (written / "map.png").write_bytes(files.get("map", b"\x89PNG1234"))
        (written / "report.json").write_text(json.dumps(report or REPORT))
        Path(f"{program}.exit").write_text(str(exit_code))
        Path(f"{program}.stdout").write_text(stdout)
        return program

    def run_tool(self, *options, old=None, new=None, only="sim-office"):
        return subprocess.run(
            [sys.executable, TOOLS / "compare-outputs", str(old or self.old), str(new or self.new), "--only", only,
             "--folder", self.folder / "kept", *options], capture_output=True, text=True, check=False,
            env={**os.environ, "SWIFTLET_DATASETS": str(self.folder / "data"), "PYTHONDONTWRITEBYTECODE": "1",
                 "PATH": f"{self.folder}:{os.environ['PATH']}"})

    def expect(self, exit_code, text, *options, **rest):
        done = self.run_tool(*options, **rest)
        self.assertEqual(done.returncode, exit_code, done.stdout + done.stderr)
        self.assertIn(text, done.stdout.splitlines())

    def test_the_same_bytes_are_the_same(self):
        self.expect(0, "sim-office: same")
        self.expect(0, "1 same, 0 differs, 0 skipped")

    def test_one_byte_is_a_difference(self):
        self.put_program("new", map=b"\x89PNG1235")
        self.expect(1, "sim-office: differs: map.png: 1 of 8 bytes")

    def test_a_trajectory_differs_by_metres_from_a_line_on(self):
        self.put_program("new", trajectory=TRAJECTORY.replace("2.0 1.0 0.0", "2.0 1.0 0.25"))
        self.expect(1, 'sim-office: differs: trajectory.tum: at most 0.25 m, line 2: "2.0 1.0 0.0 0 0 0 0 1" -> '
                       '"2.0 1.0 0.25 0 0 0 0 1"')
        self.put_program("new", trajectory=TRAJECTORY[: TRAJECTORY.index("3.0")])
        self.expect(1, 'sim-office: differs: trajectory.tum: at most 0 m, 1 stamps in one of them only, line 3: '
                       '"3.0 2.0 0.0 0 0 0 0 1" -> "(end)"')

    def test_times_and_memory_of_a_report_are_no_difference_but_counts_are(self):
        times = {**REPORT, "stage_times": {"map": {"max_ms": 9.0}, "frontend": {"max_ms": 0.5}}, "peak_memory_mb": 21}
        self.put_program("new", report=times)
        self.expect(0, "sim-office: same")
        self.put_program("new", report={**times, "backend": {"scans": 3, "closures": {"tried": 1}}})
        self.expect(1, "sim-office: differs: report.json: backend.closures.tried 2 -> 1")

    def test_a_key_of_another_name_is_none_when_the_renaming_is_given(self):
        self.put_program("new", report={**REPORT, "backend": {"scans": 3, "loops": {"tried": 2}}})
        self.expect(1, "sim-office: differs: report.json: backend.closures.tried 2 -> none, "
                       "backend.loops.tried none -> 2")
        for name in ("closures=loops", "backend.closures=backend.loops", "backend.closures.tried=backend.loops.tried"):
            self.expect(0, "sim-office: same", "--rename", name)
        self.expect(1, "sim-office: differs: report.json: backend.closures.tried 2 -> none, "
                       "backend.loops.tried none -> 2", "--rename", "map.closures=map.loops")

    def test_the_new_program_gets_its_own_names_of_settings(self):
        done = self.run_tool("--rename", "backend.max_scans=pruning.max", only="sim-patrol-pruned")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(Path(f"{self.old}.toml").read_text(), "[backend]\nmax_scans = 1000\n")
        self.assertEqual(Path(f"{self.new}.toml").read_text(), "[pruning]\nmax = 1000\n")

    def test_files_and_exit_codes_of_one_alone_are_differences(self):
        Path(f"{self.new}.files", "live.tum").write_text(TRAJECTORY)
        self.put_program("new", exit_code=2)
        self.expect(1, "sim-office: differs: exit code 0 -> 2 (a word on stderr); only NEW writes live.tum")

    def test_stdout_is_compared_where_it_is_the_result(self):
        self.put_program("new", stdout="another word\n")
        self.expect(0, "sim-office: same")
        self.put_program("old", stdout='{"samples": 1}')
        self.put_program("new", stdout='{"samples": 2}')
        self.expect(1, "calibrate-sim-office: differs: calibration.json: samples 1 -> 2", only="calibrate-sim-*")

    def test_what_the_old_program_wrote_is_kept_and_the_new_one_runs_again(self):
        for _ in range(2):
            self.expect(0, "sim-office: same")
        calls = [Path(f"{program}.calls").read_text().splitlines() for program in (self.old, self.new)]
        self.assertEqual([len(made) for made in calls], [1, 2])
        self.assertEqual(calls[1][0], "map sim://office?seed=1 -o out")
        with open(self.old, "a", encoding="utf-8") as program:
            program.write("# another build\n")
        self.expect(0, "sim-office: same")
        self.assertEqual(len(Path(f"{self.old}.calls").read_text().splitlines()), 2)

    def test_missing_data_and_programs_are_skipped_by_name(self):
        done = self.run_tool(only="olsson")
        self.assertEqual(done.returncode, 2, "nothing was compared")
        self.assertIn("olsson: skipped: flights/olsson.pcap not in ", done.stdout)
        done = self.run_tool("--only", "daemon-rice")
        self.assertEqual(done.returncode, 0)
        self.assertIn("daemon-rice: skipped: no swiftletd beside ", done.stdout)

    def test_a_build_folder_has_both_programs(self):
        build = self.folder / "build"
        for place in ("tools/swiftlet", "daemon/swiftletd"):
            (build / place).parent.mkdir(parents=True)
            self.put_program(f"build/{place}")
        self.expect(0, "daemon-rice: same", old=build, new=build, only="daemon-*")
        self.assertIn("--lcm-url memq://", (build / "daemon/swiftletd.calls").read_text())

    def test_a_commit_is_checked_out_and_built(self):
        kept = self.folder / "kept"
        self.put_stub("git", f"""case "$1" in
            rev-parse) case "$4" in abc^*) echo abc123;; *) exit 1;; esac;;
            worktree) mkdir -p {kept}/abc123; echo "$@" > {self.folder}/checked_out;;
        esac""")
        self.put_stub("cmake", f"""if [ "$1" = --build ]; then
            mkdir -p "$2/tools"; cp -r {self.old} {self.old}.* "$2/tools"
            for file in "$2/tools"/old*; do mv "$file" "$2/tools/swiftlet${{file##*/old}}"; done
        fi""")
        self.expect(0, "sim-office: same", old="abc")
        self.assertIn(f"--detach {kept}/abc123 abc123", (self.folder / "checked_out").read_text())
        done = self.run_tool(old="no-such-thing")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no-such-thing: neither a program nor a folder nor a commit", done.stderr)

    def put_stub(self, name, what):
        (self.folder / name).write_text(f"#!/bin/sh\n{what}\n")
        (self.folder / name).chmod(0o755)

    def test_what_cannot_be_meant_is_refused(self):
        for options in (("--only", "no-such-input"), ("--jobs", "0"), ("--rename", "walls")):
            self.assertEqual(self.run_tool(*options).returncode, 2, options)
        done = self.run_tool(old=self.folder / "data")
        self.assertEqual(done.returncode, 2)
        self.assertIn("holds no tools/swiftlet", done.stderr)

    def test_names_of_inputs_are_given_once_and_each_quick_one_is_short(self):
        names = [case.name for case in runs.CASES]
        self.assertEqual(len(set(names)), len(names))
        self.assertEqual({case.arguments[1] for case in runs.CASES if case.is_quick and case.name.startswith("sim-")},
                         {"sim://office?seed=1", "sim://maze?seed=1"})

    def test_of_many_keys_the_first_are_named(self):
        old, new = ({f"key{i}": value for i in range(8)} for value in (1, 2))
        text = differences.difference("report.json", json.dumps(old).encode(), json.dumps(new).encode())
        self.assertTrue(text.endswith("key4 1 -> 2, 3 keys more"), text)
        self.assertIn("unreadable", self.unreadable())

    def unreadable(self):
        Path(f"{self.new}.files", "report.json").write_text("{")
        return self.run_tool().stdout


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/test-reference-readers with programs that answer at once: what it passes on, and its exit codes."""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools/test-reference-readers"
PACKAGES = ROOT / "tests/reference_readers/package.json"
VIEWS = 'echo "flight: open http://127.0.0.1:1234 in a browser; Ctrl-C ends"; exec sleep 60'
PROGRAMS = {"npm": "", "node": 'echo "$@" >> asked; echo content', "swiftlet": f'[ $1 != view ] || {{ {VIEWS}; }}'}


class ReferenceReaders(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_with(self, path=None, **programs):
        for name, text in {**PROGRAMS, **programs}.items():
            program = self.folder / name
            program.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
            program.chmod(0o755)
        path = path or f"{self.folder}:{os.environ['PATH']}"
        command = [sys.executable, TOOL, "-o", self.folder / "work", "--swiftlet", self.folder / "swiftlet"]
        environment = {**os.environ, "PATH": path}
        return subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, text=True, check=False)

    def check(self, run, code, complaint):
        self.assertEqual((run.returncode, run.stderr), (code, f"test-reference-readers: {complaint}\n"))

    def test_the_readers_get_run_and_documented_topics(self):
        run = self.run_with()
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual(run.stdout, 3 * "content\n")
        asked = (self.folder / "asked").read_text(encoding="utf-8").splitlines()
        work = self.folder / "work"
        client = f"{work}/websocket_client.mjs ws://127.0.0.1:1234"
        expected = {f"{client} foxglove.sdk.v1 ": 10, f"{client} foxglove.websocket.v1 ": 10,
                    f"{work}/mcap_readers.mjs {work}/run.mcap {work}/map/trajectory.tum ": 11}
        for line, (before, count) in zip(asked, expected.items(), strict=True):
            self.assertEqual(line[:len(before)], before)
            topics = json.loads(line[len(before):])
            self.assertEqual(len(topics), count)
            self.assertEqual(topics["/map"], "foxglove.Grid")

    def test_without_npm_it_says_what_to_install(self):
        self.check(self.run_with(path="/nowhere"), 2, "node is missing: apt install nodejs npm")

    def test_packages_that_cannot_be_had_are_one_line(self):
        says = r"code E404\nnpm error syscall x\nnpm error 404 Not Found\nnpm error more\n"
        run = self.run_with(npm=f'printf "npm error {says}" >&2; exit 1')
        self.check(run, 2, "npm cannot install the packages: code E404; 404 Not Found")

    def test_a_reader_that_complains_is_one_line_and_exit_code_1(self):
        run = self.run_with(node="echo no message of /map >&2; exit 1")
        self.check(run, 1, "websocket_client.mjs: no message of /map")

    def test_a_swiftlet_that_fails_is_one_line_and_exit_code_1(self):
        run = self.run_with(swiftlet=f'[ $1 != view ] || {{ {VIEWS}; }}; echo note >&2; echo no space >&2; exit 3')
        self.check(run, 1, "swiftlet convert: no space")
        run = self.run_with(swiftlet="exit 3")
        self.check(run, 1, f"swiftlet view does not begin, see {self.folder}/work/view.log")

    def test_the_packages_are_of_exact_versions(self):
        versions = json.loads(PACKAGES.read_text(encoding="utf-8"))["dependencies"]
        self.assertLess({"@foxglove/ws-protocol", "@mcap/core"}, set(versions))
        for name, version in versions.items():
            self.assertTrue(re.fullmatch(r"\d+\.\d+\.\d+", version), f"{name} {version}")


if __name__ == "__main__":
    sys.exit(unittest.main())

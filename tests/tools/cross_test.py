#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/cross-test and tools/cross refuse what is no architecture of theirs and leave no test out without a reason."""

import re
import subprocess
import sys
import unittest
from pathlib import Path

TOOLS = Path(__file__).parents[2] / "tools"


class ArgumentsTest(unittest.TestCase):
    def test_anything_but_one_known_architecture_is_one_line_and_exit_code_2(self):
        for tool in ("cross-test", "cross/make-sysroot"):
            for arguments in ([], [""], ["mips"], ["arm64", "armhf"]):
                with self.subTest(tool=tool, arguments=arguments):
                    run = subprocess.run([TOOLS / tool, *arguments], capture_output=True, text=True, timeout=10)
                    self.assertEqual(run.returncode, 2)
                    self.assertEqual(run.stdout, "")
                    self.assertRegex(run.stderr, r"\A[a-z-]+: ARCH must be arm64 or armhf, not '.*'\n\Z")


class LeftOutTest(unittest.TestCase):
    def test_every_line_has_label_or_names_and_a_reason(self):
        text = (TOOLS / "cross/left-out.txt").read_text(encoding="utf-8")
        lines = [line for line in text.splitlines() if not line.startswith("#")]
        self.assertTrue(lines)
        for line in lines:
            option, pattern, reason = line.split(maxsplit=2)
            self.assertIn(option, ("-L", "-R"))
            re.compile(pattern)
            self.assertGreater(len(reason.split()), 3, line)


if __name__ == "__main__":
    sys.exit(unittest.main())

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""What the demo and the tests install on a machine that has nothing."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[2] / "tools"
NOT_FOR_THE_DEMO = {"clang", "clang-tidy", "valgrind", "stress-ng", "umockdev", "libgtest-dev", "libbenchmark-dev"}


def installed_by(*lists):
    """The packages that tools/install-packages would install where none is installed."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("dpkg-query", "exit 1"), ("sudo", 'exec "$@"'),
                           ("apt-get", f'echo "$@" >> {folder}/asked')):
            program = Path(folder, name)
            program.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
            program.chmod(0o755)
        environment = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}
        subprocess.run([TOOLS / "install-packages", *lists], env=environment, capture_output=True, check=True)
        (asked,) = Path(folder, "asked").read_text(encoding="utf-8").splitlines()
        return [word for word in asked.split()[1:] if not word.startswith("-")]


class InstallPackagesTest(unittest.TestCase):
    def test_the_demo_installs_nothing_for_tests(self):
        lists = re.findall(r"tools/install-packages (.+)", (TOOLS / "run-demo").read_text(encoding="utf-8"))
        self.assertEqual(len(lists), 1, "the demo names its lists")
        packages = set(installed_by(*lists[0].split()))
        self.assertIn("build-essential", packages)
        self.assertEqual(packages & NOT_FOR_THE_DEMO, set())

    def test_the_tests_install_each_package_of_both_lists_once(self):
        packages = installed_by()
        self.assertEqual(len(packages), len(set(packages)))
        self.assertLess(NOT_FOR_THE_DEMO | {"build-essential"}, set(packages))


if __name__ == "__main__":
    sys.exit(unittest.main())

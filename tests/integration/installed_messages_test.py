#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""A consumer of the messages, made of what is installed and of the documents' own examples alone.
installed_messages_test.py BUILD SWIFTLETD [CMAKE_OPTION...]"""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD, SWIFTLETD, *OPTIONS = sys.argv[1:]


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=120, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def example(document, language):
    """The first block of this language in a document."""
    return re.search(rf"```{language}\n(.*?)```", (ROOT / document).read_text(encoding="utf-8"), re.DOTALL)[1]


class InstalledMessagesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.prefix = Path(cls.folder.name, "prefix")
        run("cmake", "--install", BUILD, "--prefix", cls.prefix, "--component", "swiftlet")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_documents_consumer_builds_with_cmake_and_reads_a_run(self):
        project = Path(self.folder.name, "consumer")
        project.mkdir()
        (project / "CMakeLists.txt").write_text(example("proto/README.md", "cmake"), encoding="utf-8")
        (project / "consumer.cpp").write_text(example("docs/lcm.md", "cpp"), encoding="utf-8")
        run("cmake", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}", *OPTIONS)
        run("cmake", "--build", project / "build")

        log = project / "run.lcm"
        run(SWIFTLETD, "sim://patrol", "--rate", "1000", "--no-output", "--lcm-url", f"file://{log}?mode=w")
        lines = run(project / "build/consumer",
                    env={**os.environ, "LCM_DEFAULT_URL": f"file://{log}?mode=r&speed=0"}).splitlines()
        poses = [line for line in lines if re.fullmatch(r"-?\d+\.\d\d m -?\d+\.\d\d m -?\d\.\d\d rad", line)]
        tiles = [line for line in lines if re.fullmatch(r"tile -?\d+ -?\d+ of storey 0, version \d+", line)]
        self.assertGreater(len(poses), 400, "one a sample of 46 s at 10 Hz")
        self.assertGreater(len(tiles), 10)
        self.assertEqual(len(poses) + len(tiles), len(lines))

    def test_every_type_is_installed_as_source_and_as_header(self):
        types = {path.stem for path in (ROOT / "proto").glob("*.lcm")}
        self.assertEqual({path.stem for path in (self.prefix / "share/swiftlet/lcm").glob("*.lcm")}, types)
        self.assertEqual({path.stem for path in (self.prefix / "include/swiftlet").iterdir()}, types)
        jar = self.prefix / "share/swiftlet/swiftlet-messages.jar"
        if jar.exists():  # the build found a JDK
            classes = run("jar", "--list", "--file", jar).splitlines()
            self.assertEqual({Path(name).stem for name in classes if name.endswith(".class")}, types)


if __name__ == "__main__":
    sys.exit(unittest.main(argv=sys.argv[:1]))

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/check_includes.py finds each kind of fault in a small made-up repository."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import check_includes  # noqa: E402

SPDX = "// SPDX-License-Identifier: MIT\n// SPDX-FileCopyrightText: 2026 The swiftlet authors\n"


class CheckIncludes(unittest.TestCase):
    def faults(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for path, text in files.items():
                file = Path(folder, path)
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text, encoding="utf-8")
            return list(check_includes.faults_in(Path(folder)))

    def assert_fault(self, files, part):
        faults = self.faults(files)
        self.assertEqual(len(faults), 1, faults)
        self.assertIn(part, faults[0])

    def test_accepts_includes_that_run_the_right_way(self):
        self.assertEqual([], self.faults({
            "core/base/a.hpp": SPDX,
            "core/frontend/b.cpp": SPDX + '#include "core/base/a.hpp"\n#include <vector>\n',
            "daemon/c.cpp": SPDX + '#include "core/base/a.hpp"\n#include <thread>\n',
            "proto/d_t.lcm": "",
            "daemon/publish/e.cpp": SPDX + '#include "swiftlet/d_t.hpp"\n',
        }))

    def test_refuses_an_include_against_the_direction(self):
        for user, used in (("core/base", "core/geometry"), ("core/frontend", "core/backend"),
                           ("core/backend", "core/mapping"), ("core/backend/store", "core/backend/pruning"),
                           ("firmware_link/link", "core/backend"), ("firmware_link/link", "firmware_link/session"),
                           ("core/mapping", "daemon"), ("daemon/workers", "daemon/publish"), ("daemon", "tools"),
                           ("tools", "tools/python"), ("tools", "tests")):
            self.assert_fault({f"{used}/a.hpp": SPDX, f"{user}/b.hpp": SPDX + f'#include "{used}/a.hpp"\n'},
                              f"{user} must not include {used}/a.hpp")

    def test_refuses_a_folder_that_the_plan_does_not_know(self):
        self.assert_fault({"firmware_link/a.hpp": SPDX}, "firmware_link/a.hpp: its folder")

    def test_refuses_a_path_that_does_not_begin_at_the_top(self):
        self.assert_fault({"core/base/a.hpp": SPDX, "core/base/b.hpp": SPDX + '#include "a.hpp"\n'}, "no path")

    def test_refuses_casts_between_kinds_of_ids(self):
        for code in ("static_cast<KeyframeId>(scan)", "KeyframeId{index_of(scan)}", "PoseIndex(index_of(scan))",
                     "make_id<PoseIndex>(index_of(keyframe))"):
            self.assert_fault({"core/base/a.cpp": SPDX + f"auto id = {code};\n"}, "id of one kind")
        self.assertEqual([], self.faults({"core/base/a.cpp": SPDX + "auto id = make_id<KeyframeId>(3);\n",
                                          "core/base/ids.hpp": SPDX + "auto id = static_cast<KeyframeId>(3);\n"}))

    def test_refuses_threads_files_and_clocks_in_core(self):
        self.assert_fault({"core/base/a.hpp": SPDX + "#include <mutex>\n"}, "<mutex>")
        self.assert_fault({"core/base/a.hpp": SPDX + "auto t = Clock::now();\n"}, "must not read a clock")
        self.assertEqual([], self.faults({"core/base/a.hpp": SPDX + "// there is no now() here\n"}))

    def test_refuses_a_library_in_two_source_files(self):
        for header in ("libusb-1.0/libusb.h", "cholmod.h", "lcm/lcm-cpp.hpp"):
            files = {"daemon/a.cpp": SPDX + f"#include <{header}>\n", "daemon/b.cpp": SPDX + f"#include <{header}>\n"}
            self.assert_fault(files, "daemon/a.cpp, daemon/b.cpp")
            files["tests/daemon/b.cpp"] = files.pop("daemon/b.cpp")
            self.assertEqual([], self.faults(files))

    def test_refuses_two_types_of_one_name(self):
        self.assert_fault({"core/base/a.hpp": SPDX + "namespace swiftlet {\nstruct Cell {\n};\n}\n",
                           "core/base/b.hpp": SPDX + "namespace swiftlet {\nclass Cell final : Base {\n};\n}\n"},
                          "Cell is defined 2 times: in core/base/a.hpp, core/base/b.hpp")

    def test_accepts_what_a_source_defines_for_itself_or_inside_another_type(self):
        inner = "namespace swiftlet {\nstruct Outer%s {\n  struct Cell {\n  };\n};\nnamespace {\nstruct Cell {\n};\n}  // namespace\n}\n"
        self.assertEqual([], self.faults({"core/base/a.cpp": SPDX + inner % "A", "core/base/b.cpp": SPDX + inner % "B",
                                          "core/base/c.hpp": SPDX + "class Cell;\nstruct Cell {\n};\n"}))

    def test_refuses_a_file_without_licence_lines(self):
        self.assert_fault({"core/base/a.hpp": "#pragma once\n"}, "SPDX")
        self.assert_fault({"tools/run": "#!/bin/sh\necho\n"}, "SPDX")


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/accuracy_runs.py runs what a part asks for, with its settings, once for each build."""

import gzip
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import accuracy_runs as runs  # noqa: E402
import mapped_runs as mapped  # noqa: E402

OFFICE = runs.OFFICES[0]
# Stands in for swiftlet: writes down how it was called, and what the real one writes but for live.tum.
PRETENDS = """#!/bin/sh
echo "$@" >> "$0.calls"
if [ "$1" = map ]; then
  while [ "$1" != -o ]; do
    [ "$1" = --config ] && cp "$2" "$0.toml"
    shift
  done
  mkdir "$2"
  echo "5.0 1.0 2.0 0 0 0 0.6 0.8" | tee "$2/trajectory.tum" "$2/odometry.tum" > "$2/ground_truth.tum"
  echo '{"backend": 1}' > "$2/report.json"
else
  cp "$2" "$0.judged"
  echo "{\\"references\\": [{\\"of\\": \\"$(basename "$2")\\", \\"by\\": \\"$(basename "$3")\\"}]}"
fi
"""


class AccuracyRuns(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.swiftlet = Path(self.folder.name, "swiftlet")
        self.swiftlet.write_text(PRETENDS)
        self.swiftlet.chmod(0o755)

    def results(self):
        return mapped.Results(Path(self.folder.name, "kept"), self.swiftlet)

    def test_each_run_is_made_once_though_several_parts_want_it(self):
        together = runs.runs_of(["table", "beams", "kernel", "times"])
        self.assertEqual(len(together), len(set(together)))
        self.assertEqual(sum(run == runs.Run(runs.INTEL, beams=11) for run in together), 1)
        self.assertIn(runs.Run(runs.ACES, beams=4, refine=False, kernel=7), together)
        self.assertNotIn(3, {run.kernel for run in together}, "3 is the default, and that run is there already")

    def test_no_two_runs_are_kept_in_one_file(self):
        every = runs.runs_of(runs.PARTS)
        self.assertEqual(len({self.results().file(run) for run in every}), len(every))

    def test_a_changed_log_is_mapped_as_a_copy_and_what_comes_of_it_led_back(self):
        data = Path(self.folder.name, "data")
        data.mkdir()
        with gzip.open(data / "log.gz", "wt") as file:
            file.write("FLASER 2 1.0 2.0 0 0 0 0 0 0 5.0 host 5.0\nFLASER 2 1.0 2.0 0 0 0 1 0 0 6.0 host 6.0\n")
        log = mapped.Log("a log", "log.gz", "log.gz")
        run = runs.Run(log, beams=2, change=runs.Change("mirrored", mirrored=True))
        with mock.patch.object(mapped, "DATASETS", data):
            self.results().make(run, at_once=1)
            self.assertIsNotNone(self.results().get(run))
            self.assertIsNone(self.results().get(runs.Run(log, beams=2)))
        calls = Path(f"{self.swiftlet}.calls").read_text().splitlines()
        self.assertRegex(calls[0], "^map /.*/changed.clf --beams 2 ")
        self.assertEqual(Path(f"{self.swiftlet}.judged").read_text(),
                         "5.000000 1.000000 -2.000000 0 0 0 -0.600000000 0.800000000\n")

    def test_settings_become_a_configuration(self):
        run = runs.Run(runs.INTEL, beams=4, refine=False, kernel=5, multiscan=92)
        self.assertEqual(tomllib.loads(mapped.configuration(run.settings())),
                         {"frontend": {"multiscan_points": 92}, "backend": {"refine": False, "max_kernel_cells": 5}})
        self.assertEqual(mapped.configuration(runs.Run(runs.INTEL, beams=4).settings()), "")

    def test_a_run_is_mapped_with_its_settings_and_each_trajectory_judged(self):
        self.results().make(runs.Run(OFFICE, beams=6, refine=False), at_once=2)
        result = self.results().get(runs.Run(OFFICE, beams=6, refine=False))
        calls = Path(f"{self.swiftlet}.calls").read_text().splitlines()
        self.assertTrue(calls[0].startswith("map sim://office?seed=1 --beams 6 --config "), calls[0])
        self.assertEqual(Path(f"{self.swiftlet}.toml").read_text(), "[backend]\nrefine = false\n")
        self.assertEqual(result["final"], {"of": "trajectory.tum", "by": "ground_truth.tum"})
        self.assertEqual(result["odometry"]["of"], "odometry.tum")
        self.assertIsNone(result["live"], "a program that writes no such file has no such figures")
        self.assertEqual(result["report"], {"backend": 1})
        self.assertEqual(result["at_once"], 2)

    def test_results_are_kept_for_the_same_settings_of_the_same_program_only(self):
        self.results().make(runs.Run(OFFICE), at_once=1)
        self.assertIsNotNone(self.results().get(runs.Run(OFFICE)))
        self.assertIsNone(self.results().get(runs.Run(OFFICE, refine=False)))
        self.assertIsNone(self.results().get(runs.Run(runs.OFFICES[1])))
        self.swiftlet.write_text(PRETENDS + "# another build\n")
        self.assertIsNone(self.results().get(runs.Run(OFFICE)))

    def test_results_of_other_data_or_of_another_change_are_not_taken(self):
        data = Path(self.folder.name, "log.clf")
        data.write_text("one")
        log = mapped.Log("a log", "log.clf", "log.clf")
        with mock.patch.object(mapped, "DATASETS", Path(self.folder.name)):
            files = {self.results().file(runs.Run(log, change=change))
                     for change in (None, runs.Change("worse", metres=1.1), runs.Change("worse", metres=1.2))}
            before = self.results().file(runs.Run(log))
            elsewhere = Path(self.folder.name, "copies")
            elsewhere.mkdir()
            Path(elsewhere, "log.clf").write_text("one")
        with mock.patch.object(mapped, "DATASETS", elsewhere):
            self.assertEqual(self.results().file(runs.Run(log)), before)
            Path(elsewhere, "log.clf").write_text("another")
            mapped.content_digest.cache_clear()
            self.assertNotEqual(self.results().file(runs.Run(log)), before)
        self.assertEqual(len(files), 3)

    def test_results_by_other_code_of_ours_are_not_taken(self):
        code = Path(self.folder.name, "code.py")
        code.write_text("as it was")
        by_cells = mapped.Log("a log", "log.clf", "log.clf")
        by_relations = mapped.Log("a log", "log.clf", "log.relations")

        def files(module):
            wanted = [runs.Run(by_cells), runs.Run(by_relations),
                      runs.Run(by_relations, change=runs.Change("worse", metres=1.1))]
            with mock.patch.object(module, "__file__", str(code)), \
                    mock.patch.object(mapped, "DATASETS", Path(self.folder.name)):
                return [self.results().file(run) for run in wanted]

        def differ(module):
            code.write_text("as it was")
            before = files(module)
            code.write_text("changed")
            return [old != new for old, new in zip(before, files(module))]

        self.assertEqual(differ(mapped.log_sharpness), [True, False, False])
        self.assertEqual(differ(mapped.changed_log), [True, False, True])
        self.assertEqual(differ(mapped.changed_capture), [False, False, True])

    def test_a_simulation_needs_no_data_and_a_log_names_what_is_not_there(self):
        self.assertEqual(OFFICE.missing(), [])
        elsewhere = mapped.Log("nowhere", "no/such.clf", "no/such.relations")
        self.assertEqual(elsewhere.missing(), ["no/such.clf", "no/such.relations"])


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""swiftlet.map() beside `swiftlet map`. mapping_test.py SWIFTLET SWIFTLETD"""

import json
import os
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings
from pathlib import Path

import numpy as np

import swiftlet
from interrupted_program import exit_code_after_ctrl_c
from map_picture import FREE, OCCUPIED, UNKNOWN, pixels_of

SWIFTLET = sys.argv[1]
INPUT = "sim://patrol?seed=3"
# For what stops it.
LONG = "sim://office?seed=1&laps=30"


def poses_of(path):
    """Time, x, y and yaw of a TUM file."""
    stamp, x, y, _, _, _, qz, qw = np.loadtxt(path).T
    return np.column_stack([stamp, x, y, 2 * np.arctan2(qz, qw)])


class MappedFlight(unittest.TestCase):
    """One flight, mapped by the program and in Python."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name, "out")
        subprocess.run([SWIFTLET, "map", INPUT, "-o", cls.out], check=True, capture_output=True)
        cls.also = Path(cls.folder.name, "also")
        cls.progress = []
        cls.run_ = swiftlet.map(INPUT, output=cls.also, on_progress=cls.progress.append)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_arrays_are_what_the_program_writes(self):
        run = self.run_
        self.assertGreater(len(run.trajectory), 400)
        for name, array in (("trajectory", run.trajectory), ("live", run.live), ("odometry", run.odometry),
                            ("ground_truth", run.truth)):
            written = poses_of(self.out / f"{name}.tum")
            self.assertEqual(array.dtype, np.float64)
            np.testing.assert_allclose(array, written, atol=2e-6, err_msg=name)
        shown = np.full(run.grid.occupancy_percent.shape, UNKNOWN)
        shown[run.grid.free], shown[run.grid.occupied] = FREE, OCCUPIED
        np.testing.assert_array_equal(shown[::-1], pixels_of(self.out / "map.pgm"))
        x_m, y_m = run.grid.origin_m
        self.assertIn(f"origin: [{x_m:.6f}, {y_m:.6f}, 0.0]", (self.out / "map.yaml").read_text())

    def test_the_report_is_the_programs(self):
        report = json.loads((self.out / "report.json").read_text())
        for part in ("input", "sensor", "calibration", "frontend", "backend", "tracking", "trajectory", "map",
                     "absolute_trajectory_error", "known_place_error", "consistency"):
            self.assertEqual(self.run_.report[part], report[part], part)

    def test_the_files_are_the_programs(self):
        names = sorted(path.name for path in self.out.iterdir())
        self.assertEqual(sorted(path.name for path in self.also.iterdir()), names)
        self.assertEqual(sorted(self.run_.report["files"]), names)
        for name in set(names) - {"report.json"}:
            self.assertEqual((self.also / name).read_bytes(), (self.out / name).read_bytes(), name)

    def test_each_live_pose_has_its_covariances(self):
        run = self.run_
        for covariances in (run.covariances, run.covariances_map):
            self.assertEqual(covariances.shape, (len(run.live), 3, 3))
            np.testing.assert_array_equal(covariances, covariances.transpose(0, 2, 1))
            self.assertGreater(np.linalg.eigvalsh(covariances[20:]).min(), 0)
        sigma_m = np.sqrt(run.covariances[:, 0, 0] + run.covariances[:, 1, 1])
        self.assertLess(sigma_m[0], sigma_m.max())
        self.assertLess(sigma_m.max(), 3.0)

    def test_walls_and_closures_lie_on_the_map(self):
        left, right, low, high = self.run_.grid.extent_m
        self.assertGreater(len(self.run_.walls), 3)
        closures = self.run_.report["backend"]["closures"]
        self.assertEqual(len(self.run_.closures), closures["accepted"] - closures["dropped"])
        self.assertEqual(len(self.run_.dropped_closures), closures["dropped"])
        for segments in (self.run_.walls, self.run_.closures, self.run_.dropped_closures):
            self.assertEqual(segments.shape[1:], (4,))
            self.assertTrue(((segments[:, ::2] >= left) & (segments[:, ::2] <= right)).all())
            self.assertTrue(((segments[:, 1::2] >= low) & (segments[:, 1::2] <= high)).all())

    def test_the_first_storey_is_the_grid(self):
        self.assertIs(self.run_.storeys[0], self.run_.grid)

    def test_rows_say_on_which_storey_they_are(self):
        run = self.run_
        for storeys, rows in ((run.trajectory_storeys, run.trajectory), (run.wall_storeys, run.walls),
                              (run.closure_storeys, run.closures),
                              (run.dropped_closure_storeys, run.dropped_closures)):
            np.testing.assert_array_equal(storeys, np.zeros(len(rows), dtype=np.int8))

    def test_the_grid_says_where_its_cells_are(self):
        grid = self.run_.grid
        row, column = grid.cell(grid.origin_m[0] + 2.5 * grid.resolution_m, grid.origin_m[1] + 7.5 * grid.resolution_m)
        self.assertEqual((row, column), (7, 2))
        known = grid.occupancy_percent >= 0
        np.testing.assert_array_equal(np.isnan(grid.probability), ~known)
        np.testing.assert_allclose(grid.probability[known], grid.occupancy_percent[known] / 100)
        self.assertTrue(grid.free[grid.cell(*self.run_.trajectory[0, 1:3])], "it began in the open")

    def test_progress_goes_up_to_one(self):
        self.assertEqual(self.progress, sorted(self.progress))
        self.assertEqual(self.progress[-1], 1.0)


class House(unittest.TestCase):
    """Of two storeys."""

    @classmethod
    def setUpClass(cls):
        cls.run_ = swiftlet.map("sim://storeys?seed=1")

    def test_rows_say_on_which_storey_they_are(self):
        run = self.run_
        self.assertEqual(sorted(run.storeys), [0, 1])
        self.assertEqual(run.trajectory_storeys.shape, (len(run.trajectory),))
        self.assertEqual(run.trajectory_storeys.dtype, np.int8)
        self.assertEqual((run.trajectory_storeys[0], set(run.trajectory_storeys)), (0, {0, 1}))
        closures = run.report["backend"]["closures"]
        self.assertEqual(len(run.closures), closures["accepted"] - closures["dropped"], "on all storeys")
        for storeys, rows in ((run.wall_storeys, run.walls), (run.closure_storeys, run.closures)):
            for storey, grid in run.storeys.items():
                left, right, low, high = grid.extent_m
                here = rows[storeys == storey]
                self.assertGreater(len(here), 2)
                self.assertTrue(((here[:, ::2] >= left) & (here[:, ::2] <= right)).all())
                self.assertTrue(((here[:, 1::2] >= low) & (here[:, 1::2] <= high)).all())

    def test_walls_are_on_the_grid_of_their_storey(self):
        run = self.run_

        def share_on(grid, walls):
            cells = [grid.cell(x_m, y_m) for x_m, y_m in (walls[:, :2] + walls[:, 2:]) / 2]
            return np.mean([grid.occupied[row - 1:row + 2, column - 1:column + 2].any() for row, column in cells])

        for storey, other in ((0, 1), (1, 0)):
            walls = run.walls[run.wall_storeys == storey]
            self.assertGreater(share_on(run.storeys[storey], walls), share_on(run.storeys[other], walls) + 0.2)

    def test_a_table_of_its_samples_keeps_them(self):
        with tempfile.TemporaryDirectory() as folder:
            table = Path(folder, "house.csv")
            subprocess.run([SWIFTLET, "convert", "sim://storeys?seed=1", table], check=True, capture_output=True)
            again = swiftlet.map(table)
        self.assertEqual(len(again.trajectory_storeys), len(self.run_.trajectory_storeys))
        # Both find an age of the ranges, and by that which sample is the first upstairs.
        self.assertLessEqual(np.count_nonzero(again.trajectory_storeys != self.run_.trajectory_storeys), 2)


class Options(unittest.TestCase):
    def test_settings_stand_above_those_of_the_file(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write("[map]\nresolution_m = 0.2\nclear_range_m = 2.0\n")
            file.flush()
            of_file = swiftlet.map(INPUT, config=file.name, calibrate=False)
            of_both = swiftlet.map(INPUT, config=Path(file.name), calibrate=False,
                                   settings={"map": {"resolution_m": np.float64(0.1)}, "backend.close_loops": False})
        self.assertEqual((of_file.grid.resolution_m, of_both.grid.resolution_m), (0.2, 0.1))
        self.assertEqual(len(of_both.closures), 0)
        self.assertNotIn("files", of_both.report, "none was written")

    def test_the_baselines_correct_less(self):
        odometry = swiftlet.map(INPUT, odometry_only=True)
        frontend = swiftlet.map(INPUT, frontend_only=True)
        self.assertEqual((len(odometry.walls), len(odometry.closures), len(frontend.closures)), (0, 0, 0))
        self.assertGreater(len(frontend.walls), 0)

    def test_bad_input_is_one_line(self):
        for line, options in {
                "nowhere.pcap": {"input": "nowhere.pcap"},
                "radio://0: a live vehicle has no end": {"input": "radio://0"},
                "no such configuration file": {"config": "/nowhere.toml"},
                'settings: unknown key "map.size"': {"settings": {"map.size": 3}},
                "settings: map.resolution_m": {"settings": {"map.resolution_m": 99}},
                "map.resolution_m must be a number": {"settings": {"map.resolution_m": "fine"}},
                'settings: "resolution_m" is no key': {"settings": {"resolution_m": 0.1}},
                "must be true or false, a number or a text": {"settings": {"map.resolution_m": None}},
                "beams = 1: must lie between 2 and": {"beams": 1},
                "odometry_only excludes": {"odometry_only": True, "frontend_only": True},
                "nowhere/at/all": {"output": "/proc/nowhere/at/all"}}.items():
            with self.subTest(line), self.assertRaises(swiftlet.Error) as refused:
                swiftlet.map(**{"input": INPUT, **options})
            self.assertIn(line, str(refused.exception))
            self.assertNotIn("\n", str(refused.exception))

    def test_a_damaged_capture_gives_what_came_before_with_a_warning(self):
        with tempfile.TemporaryDirectory() as folder:
            whole = Path(folder, "flight.pcap")
            subprocess.run([SWIFTLET, "record", INPUT, "-o", whole], check=True, capture_output=True)
            cut = Path(folder, "cut.pcap")
            cut.write_bytes(whole.read_bytes()[:-whole.stat().st_size // 3])
            with self.assertWarnsRegex(swiftlet.DamagedInputWarning, r"cut\.pcap"):
                run = swiftlet.map(cut, calibrate=False)
            self.assertEqual(len(run.problems), 1)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                self.assertLess(len(run.trajectory), len(swiftlet.map(whole, calibrate=False).trajectory))


class Names(unittest.TestCase):
    """Of files, which are bytes, and what is quoted of damaged ones."""

    def test_what_is_not_utf_8_is_replaced_in_messages(self):
        with tempfile.TemporaryDirectory() as folder:
            table = Path(folder, os.fsdecode(b"b\xff.csv"))
            subprocess.run([SWIFTLET, "convert", INPUT, table], check=True, capture_output=True)
            whole = swiftlet.map(table, calibrate=False)
            self.assertEqual(whole.problems, ())
            with open(table, "ab") as file:
                file.write(b"\xff\xfe no row \xc3\n")
            with self.assertWarnsRegex(swiftlet.DamagedInputWarning, "b\ufffd\\.csv, line "):
                run = swiftlet.map(os.fspath(table), calibrate=False)
            np.testing.assert_array_equal(run.trajectory, whole.trajectory)
            self.assertEqual(list(run.problems), run.report["input"]["problems"])
            with self.assertRaisesRegex(swiftlet.Error, "c\ufffd\\.csv: no such file"):
                swiftlet.map(Path(folder, os.fsdecode(b"c\xff.csv")))
            with self.assertRaisesRegex(swiftlet.Error, "c\ufffd\\.toml: no such configuration file"):
                swiftlet.map(INPUT, config=Path(folder, os.fsdecode(b"c\xff.toml")))
            out = Path(folder, os.fsdecode(b"out\xff"))
            swiftlet.map(INPUT, output=out, calibrate=False)
            self.assertTrue((out / "map.png").exists())

    def test_what_is_no_name_is_one_line(self):
        for line, options in {
                "is no name of a file": {"input": "\ud800.csv"},
                "config names no file": {"config": ""},
                "-o names no directory": {"output": ""},
                "holds what is not UTF-8": {"settings": {"record.directory": "\udcff"}}}.items():
            with self.subTest(line), self.assertRaises(swiftlet.Error) as refused:
                swiftlet.map(**{"input": INPUT, **options})
            self.assertIn(line, str(refused.exception))
            self.assertNotIn("\n", str(refused.exception))


class Running(unittest.TestCase):
    def test_other_threads_run_meanwhile(self):
        begun, over = threading.Event(), threading.Event()
        counts = []

        def count():
            n = 0
            while not over.is_set():
                n += 1
                if n == 1000:
                    begun.set()
            counts.append(n)

        def stop_once_another_thread_ran(_):
            if begun.is_set():
                raise StopAsyncIteration
        other = threading.Thread(target=count)
        other.start()
        try:
            with self.assertRaises(StopAsyncIteration):
                swiftlet.map(LONG, calibrate=False, on_progress=stop_once_another_thread_ran)
        finally:
            over.set()
            other.join()
        self.assertGreater(counts[0], 1000)

    def test_ctrl_c_stops_it(self):
        script = ("import swiftlet, sys\n"
                  "def tell(share):\n"
                  "    print('begun', flush=True)\n"
                  f"try:\n    swiftlet.map({LONG!r}, calibrate=False, on_progress=tell)\n"
                  "except KeyboardInterrupt:\n    sys.exit(3)\n")
        self.assertEqual(exit_code_after_ctrl_c(script), 3)

    def test_two_runs_at_once_give_the_same(self):
        runs = {}
        threads = [threading.Thread(target=lambda n=n: runs.update({n: swiftlet.map(INPUT, calibrate=False)}))
                   for n in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        np.testing.assert_array_equal(runs[0].trajectory, runs[1].trajectory)

    def test_nothing_is_printed(self):
        done = subprocess.run([sys.executable, "-c", f"import swiftlet; swiftlet.map({INPUT!r})"], check=True,
                              capture_output=True, env=os.environ)
        self.assertEqual((done.stdout, done.stderr), (b"", b""))


if __name__ == "__main__":
    sys.exit(unittest.main(argv=sys.argv[:1]))

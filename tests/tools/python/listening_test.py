#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""swiftlet.listen() on what swiftletd publishes. listening_test.py SWIFTLET SWIFTLETD"""

import dataclasses
import os
import re
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import swiftlet
from interrupted_program import exit_code_after_ctrl_c
from map_picture import FREE, OCCUPIED, UNKNOWN, pixels_of

SWIFTLETD = sys.argv[2]
PROTO = Path(__file__).resolve().parents[3] / "proto"
ALL = (swiftlet.Pose, swiftlet.Ranges, swiftlet.Tile, swiftlet.Walls, swiftlet.Closure,
       swiftlet.VehicleEvent, swiftlet.Status)


class PublishedRun(unittest.TestCase):
    """A run whose messages lie in a log of LCM's."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name, "out")
        log = Path(cls.folder.name, "run.lcm")
        subprocess.run([SWIFTLETD, "sim://loop?seed=1", "--rate", "1000", "-o", cls.out,
                        "--lcm-url", f"file://{log}?mode=w"], check=True, capture_output=True)
        cls.url = f"file://{log}?mode=r&speed=0"
        cls.messages = list(swiftlet.listen(cls.url, messages=ALL, frames=("map", "local", "odom")))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def of(self, kind):
        return [message for message in self.messages if isinstance(message, kind)]

    def test_poses_are_those_that_were_written(self):
        for frame, name in (("map", "live"), ("odom", "odometry")):
            poses = [pose for pose in self.of(swiftlet.Pose) if pose.frame == frame]
            stamp, x, y, _, _, _, qz, qw = np.loadtxt(self.out / f"{name}.tum").T
            written = np.column_stack([stamp, x, y, 2 * np.arctan2(qz, qw)])
            received = np.array([(pose.time_s, pose.x_m, pose.y_m, pose.yaw_rad) for pose in poses])
            np.testing.assert_allclose(received, written, atol=2e-6, err_msg=name)
            self.assertEqual([pose.sequence for pose in poses], list(range(len(poses))))
        local = [pose for pose in self.of(swiftlet.Pose) if pose.frame == "local"]
        self.assertEqual(len(local), len(written))
        self.assertEqual({pose.tracking for pose in self.of(swiftlet.Pose)} - {"good", "uncertain"}, set())

    def test_covariances_are_matrices_in_frame_map(self):
        for pose in self.of(swiftlet.Pose)[300:]:
            for P in (pose.covariance_map, pose.covariance_start):
                self.assertEqual(P.shape, (3, 3))
                if pose.frame == "map":
                    self.assertGreater(np.linalg.eigvalsh(P).min(), 0)
                else:
                    self.assertFalse(P.any())

    def test_the_beams_of_a_pose_end_at_the_walls(self):
        beams = self.of(swiftlet.Ranges)
        poses = [pose for pose in self.of(swiftlet.Pose) if pose.frame == "map"]
        self.assertEqual([each.sequence for each in beams], [pose.sequence for pose in poses])
        self.assertEqual([each.time_s for each in beams], [pose.time_s for pose in poses])
        measured_s = np.diff([each.device_time_s for each in beams])
        self.assertTrue(0 < measured_s.min() and measured_s.max() < 1, "the vehicle's clock, in seconds")
        for each in beams:
            np.testing.assert_allclose(each.bearing_rad, np.pi * np.array([0, 0.5, 1, -0.5]), atol=1e-6)
            self.assertTrue((each.distance_m[each.status == swiftlet.Ranges.HIT] <= each.max_range_m).all())
            self.assertFalse(each.distance_m[each.status != swiftlet.Ranges.HIT].any())
        self.assertEqual({int(code) for each in beams for code in each.status} & {0, 1}, {0, 1})
        grid = swiftlet.TileMap()
        for tile in self.of(swiftlet.Tile):
            grid.add(tile)
        corrected = [dataclasses.replace(pose, x_m=x, y_m=y, yaw_rad=2 * np.arctan2(qz, qw)) for pose, (x, y, qz, qw)
                     in zip(poses, np.loadtxt(self.out / "trajectory.tum", usecols=(1, 2, 6, 7)))]
        hits = np.vstack([each.hits_m(pose) for each, pose in zip(beams, corrected)])
        columns, rows = np.floor((hits - grid.grid().origin_m) / grid.grid().resolution_m).astype(int).T
        self.assertGreater(grid.grid().occupied[rows, columns].mean(), 0.6, "of the hits that the map was drawn of")

    def test_tiles_come_to_the_map_that_was_written(self):
        tiles = swiftlet.TileMap()
        with self.assertRaises(swiftlet.Error):
            tiles.grid()
        complete = []
        for message in self.messages:
            if isinstance(message, swiftlet.Tile):
                tiles.add(message)
            elif isinstance(message, swiftlet.Status):
                complete.append(tiles.is_complete(message))
        self.assertTrue(complete[-1])
        grid = tiles.grid()
        shown = np.full(grid.occupancy_percent.shape, UNKNOWN)
        shown[grid.free], shown[grid.occupied] = FREE, OCCUPIED
        # Tiles from which everything was rubbed out are sent, but not written.
        rows, columns = np.nonzero(grid.occupancy_percent >= 0)
        written = pixels_of(self.out / "map.pgm")
        self.assertEqual((shown == OCCUPIED).sum(), (written == OCCUPIED).sum())
        self.assertEqual((shown == FREE).sum(), (written == FREE).sum())
        origin = re.search(r"origin: \[(\S+), (\S+),", (self.out / "map.yaml").read_text())
        column, row = (round((float(origin[i]) - grid.origin_m[i - 1]) / grid.resolution_m) for i in (1, 2))
        height, width = written.shape
        np.testing.assert_array_equal(shown[row:row + height, column:column + width][::-1], written)
        self.assertTrue(len(rows) == len(columns) > 1000)

    def test_an_older_tile_and_another_run_are_told_apart(self):
        first = self.of(swiftlet.Tile)[0]
        tiles = swiftlet.TileMap()
        self.assertTrue(tiles.add(dataclasses.replace(first, version=2)))
        self.assertFalse(tiles.add(first))
        self.assertTrue(tiles.add(dataclasses.replace(first, map_id=1, tile_x=first.tile_x + 1)))
        self.assertEqual(tiles.grid().occupancy_percent.shape, (64, 64), "the tile of the run before is gone")
        self.assertEqual(tiles.grid().origin_m, dataclasses.replace(first, tile_x=first.tile_x + 1).grid.origin_m)

    def test_each_storey_has_a_grid_of_its_own(self):
        first = self.of(swiftlet.Tile)[0]
        above = dataclasses.replace(first, storey=1, occupancy_percent=np.full((64, 64), 7, dtype=np.int8))
        tiles = swiftlet.TileMap()
        self.assertTrue(tiles.add(first) and tiles.add(above))
        np.testing.assert_array_equal(tiles.grid().occupancy_percent, first.occupancy_percent)
        np.testing.assert_array_equal(tiles.grid(1).occupancy_percent, above.occupancy_percent)
        with self.assertRaises(swiftlet.Error):
            tiles.grid(2)

    def test_walls_and_closures_have_their_places(self):
        left, right, low, high = -60, 60, -60, 60
        walls = self.of(swiftlet.Walls)[-1]
        self.assertGreater(len(walls.ids), 4)
        self.assertEqual(walls.segments_m.shape, (len(walls.ids), 4))
        self.assertTrue(((walls.segments_m > left) & (walls.segments_m < right)).all())
        closures = self.of(swiftlet.Closure)
        self.assertGreater(len(closures), 0, "the flight closes its loop")
        for closure in closures:
            self.assertTrue(left < closure.from_m[0] < right and low < closure.to_m[1] < high)
            self.assertTrue(0 < closure.score <= 1 and closure.from_keyframe < closure.to_keyframe)

    def test_the_last_status_says_that_it_is_over(self):
        status = self.messages[-1]
        self.assertEqual(status.state, "finished")
        poses = [pose for pose in self.of(swiftlet.Pose) if pose.frame == "map"]
        self.assertEqual(status.samples, len(poses))
        self.assertEqual((status.link.condition, status.link.client), ("none", None))
        self.assertTrue(3.0 < status.link.battery_v < 4.3)
        self.assertIn("frontend", {stage.name for stage in status.stages})
        self.assertGreater(len(status.queues), 3)
        self.assertEqual([status.state for status in self.of(swiftlet.Status)].count("finished"), 1)

    def test_a_listener_that_follows_reads_to_the_end_of_the_log(self):
        followed = list(swiftlet.listen(self.url, messages=[swiftlet.Status], follow=True))
        self.assertEqual([status.state for status in followed].count("finished"), 3)

    def test_nothing_is_received_once_the_run_has_finished(self):
        for kind in (swiftlet.Status, swiftlet.Tile):
            listener = swiftlet.listen(self.url, messages=[kind])
            received = []
            while (message := listener.receive()) is not None:
                received.append(message)
            self.assertGreater(len(received), 0)
            self.assertIsNone(listener.receive())
            if kind is swiftlet.Status:
                self.assertEqual([status.state for status in received].count("finished"), 1)

    def test_what_was_not_asked_for_is_not_yielded(self):
        kinds = {type(message) for message in swiftlet.listen(self.url, messages=[swiftlet.Tile])}
        self.assertEqual(kinds, {swiftlet.Tile})
        self.assertEqual(list(swiftlet.listen(self.url, channel_prefix="OTHER_")), [])

    def test_each_field_of_the_types_has_a_place(self):
        renamed = {"utime": "time_s", "occupancy_percent": "occupancy_percent", "ack_rate": "ack_rate",
                   "sent_rate": "sent_hz", "received_rate": "received_hz", "sample_rate": "sample_rate_hz",
                   "from_map": "from_m", "to_map": "to_m", "device_utime": "device_time_s"}
        for name, kind in (("pose_t", swiftlet.Pose), ("ranges_t", swiftlet.Ranges), ("map_tile_t", swiftlet.Tile),
                           ("status_t", swiftlet.Status), ("loop_closure_t", swiftlet.Closure),
                           ("vehicle_event_t", swiftlet.VehicleEvent),
                           ("link_status_t", swiftlet.Link), ("tracking_t", swiftlet.Tracking),
                           ("queue_status_t", swiftlet.Queue), ("stage_time_t", swiftlet.Stage)):
            places = {field.name for field in dataclasses.fields(kind)}
            text = (PROTO / f"{name}.lcm").read_text()
            for field in re.findall(r"^  (?!const)\w+ (\w+)(?:\[.*\])?;", text, re.MULTILINE):
                if field in ("count", "queue_count", "stage_count"):
                    continue
                wanted = {renamed.get(field, field)} | {f"{field}{unit}" for unit in ("_m", "_rad", "_ms")}
                self.assertTrue(places & wanted, f"{name}.{field} is missing in {kind.__name__}")


class Waiting(unittest.TestCase):
    def test_silence_is_told(self):
        listener = swiftlet.listen("memq://", timeout=0.01)
        self.assertIsNone(listener.receive(timeout=0.0))
        with self.assertRaisesRegex(swiftlet.Timeout, r"memq://: nothing received for 0\.01 s"):
            next(listener)
        with self.assertRaises(TimeoutError):
            next(listener)

    def test_a_timeout_is_a_number(self):
        nan = float("nan")
        with self.assertRaisesRegex(swiftlet.Error, "timeout = nan"):
            swiftlet.listen("memq://", timeout=nan)
        with self.assertRaisesRegex(swiftlet.Error, "timeout = nan"):
            swiftlet.listen("memq://").receive(nan)

    def test_an_address_need_not_be_utf_8(self):
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(swiftlet.Error, "no\ufffd\\.lcm"):
            swiftlet.listen(f"file://{folder}/" + os.fsdecode(b"no\xff.lcm?mode=r"))

    def test_an_address_that_cannot_be_used_is_one_line(self):
        for options in ({"url": "http://127.0.0.1"}, {"url": "\ud800"}, {"url": "memq://", "messages": [int]},
                        {"url": "memq://", "frames": ["world"]}, {"url": "file:///nowhere/run.lcm?mode=r"}):
            with self.subTest(options), self.assertRaises(swiftlet.Error) as refused:
                swiftlet.listen(**options)
            self.assertNotIn("\n", str(refused.exception))

    def test_a_closed_listener_yields_nothing(self):
        with swiftlet.listen("memq://") as listener:
            pass
        self.assertEqual(list(listener), [])
        with self.assertRaises(swiftlet.Error):
            listener.receive()

    def test_two_threads_need_two_listeners(self):
        listener, refusals = swiftlet.listen("memq://"), []
        until = time.monotonic() + 30.0

        def receive():
            while not refusals and time.monotonic() < until:
                try:
                    listener.receive(timeout=0.01)
                except swiftlet.Error as refusal:
                    refusals.append(refusal)

        other = threading.Thread(target=receive)
        other.start()
        receive()
        other.join()
        self.assertTrue(refusals)

    def test_ctrl_c_ends_a_wait(self):
        script = ("import swiftlet, sys\nlistener = swiftlet.listen('memq://')\n"
                  "try:\n    print('begun', flush=True)\n    next(listener)\n"
                  "except KeyboardInterrupt:\n    sys.exit(3)\n")
        self.assertEqual(exit_code_after_ctrl_c(script), 3)


if __name__ == "__main__":
    sys.exit(unittest.main(argv=sys.argv[:1]))

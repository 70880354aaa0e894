#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/changed_log.py changes what it says, keeps the rest, and leads a trajectory back to the log."""

import gzip
import math
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import changed_log as changed  # noqa: E402

SIDE_M = 30.0
STEP_M = 0.5
LATE_S = changed.BEHIND_ODOMETRY_S


def square():
    """Once round a square to the left, with scans whose first range counts them; both stamped each second."""
    poses, x, y = [], 0.0, 0.0
    for corner in range(4):
        yaw = math.remainder(corner * math.pi / 2, math.tau)
        for _ in range(int(SIDE_M / STEP_M)):
            poses.append((x, y, yaw))
            x, y = x + STEP_M * math.cos(yaw), y + STEP_M * math.sin(yaw)
    return [(100.0 + i, pose) for i, pose in enumerate(poses)]


def log_text(poses):
    return "".join(f"# a comment\nODOM {x} {y} {yaw} 0 0 0 {t} host {t}\n"
                   f"FLASER 3 {i} 2.0 3.0 9 9 9 {x} {y} {yaw} {t} host {t}\n"
                   for i, (t, (x, y, yaw)) in enumerate(poses))


class ChangedLog(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.log = self.folder / "log.gz"
        with gzip.open(self.log, "wt") as file:
            file.write(log_text(square()))
        self.recording = changed.read(self.log)

    def assert_same_pose(self, pose, wanted):
        self.assertAlmostEqual(pose[0], wanted[0], places=4)
        self.assertAlmostEqual(pose[1], wanted[1], places=4)
        self.assertAlmostEqual(math.remainder(pose[2] - wanted[2], math.tau), 0.0, places=4)

    def copy(self, **choices):
        """The changed copy, as read again."""
        change = changed.Change("some", **choices)
        changed.write(self.recording, change, self.folder / "copy")
        with gzip.open(self.folder / "copy.gz", "wt") as file:
            file.write((self.folder / "copy").read_text())
        return changed.read(self.folder / "copy.gz")

    def test_a_copy_without_a_change_says_the_same_with_scans_at_the_moment_they_were_measured(self):
        copy = self.copy()
        self.assertEqual([ranges for _, ranges in copy.scans], [ranges for _, ranges in self.recording.scans])
        for (stamp, _), (there, _) in zip(copy.scans, square()):
            self.assertAlmostEqual(stamp, there - LATE_S, places=5)
        for (stamp, pose), (there, expected) in zip(copy.poses, square()):
            self.assertAlmostEqual(stamp, there, places=5)
            self.assert_same_pose(pose, expected)

    def only_scans(self, lines_ahead):
        with gzip.open(self.log, "wt") as file:
            file.writelines(line for line in log_text(square()).splitlines(True) if line.startswith("FLASER"))
        return changed.read(self.log, lines_ahead)

    def test_poses_come_from_the_scans_where_there_is_no_odometry(self):
        self.assertEqual(self.only_scans(0).poses, self.recording.poses)
        ahead = self.only_scans(1)
        self.assertEqual([pose for _, pose in ahead.poses[1:]], [pose for _, pose in self.recording.poses[:-1]])
        self.assertEqual([stamp for stamp, _ in ahead.poses], [stamp for stamp, _ in ahead.scans])

    def test_poses_come_from_the_scans_where_the_stamps_of_the_odometry_go_back(self):
        with gzip.open(self.log, "at") as file:
            file.write("ODOM 0 0 0 0 0 0 99.5 host 99.5\n")
        self.assertEqual(changed.read(self.log).poses, self.recording.poses)

    def test_a_copy_keeps_poses_in_the_scans_and_each_beside_its_own_also_backwards(self):
        self.recording = self.only_scans(1)
        copy = self.copy(backwards=True)
        self.assertTrue(copy.is_odometry_in_scans)
        for (_, pose), (_, before) in zip(copy.poses, self.recording.poses[::-1]):
            self.assert_same_pose(pose, before)
        self.assertEqual([ranges for _, ranges in copy.scans], [ranges for _, ranges in self.recording.scans[::-1]])

    def test_backwards_each_scan_stays_beside_the_pose_it_was_measured_at(self):
        ends = self.recording.ends_s()
        copy = self.copy(backwards=True)
        for (stamp, ranges), (before, same) in zip(copy.scans, self.recording.scans[::-1]):
            self.assertEqual(ranges, same)
            self.assertAlmostEqual(stamp, ends - before, places=5)
        self.assertAlmostEqual(copy.poses[0][0], ends - self.recording.poses[-1][0], places=5)
        self.assertAlmostEqual(copy.poses[-1][1][0], 0.0, places=4)

    def test_mirrored_the_way_leads_round_to_the_right_and_left_ranges_are_right(self):
        copy = self.copy(mirrored=True)
        self.assertEqual(copy.scans[7][1], ["3.0", "2.0", "7"])
        self.assertAlmostEqual(min(y for _, (_, y, _) in copy.poses), -SIDE_M, places=3)

    def test_errors_of_dead_reckoning_are_those_asked_for(self):
        straight = int(SIDE_M / STEP_M) - 1  # last pose of the first side
        self.assertAlmostEqual(self.copy(metres=1.1).poses[straight][1][0], 1.1 * straight * STEP_M, places=3)
        for drift_deg in (1.0, -1.0):
            self.assertAlmostEqual(self.copy(drift_deg_per_m=drift_deg).poses[straight][1][2],
                                   math.radians(drift_deg * straight * STEP_M), places=4)
        self.assertAlmostEqual(self.copy(turns=0.9).poses[straight + 1][1][2], 0.9 * math.pi / 2, places=4)

    def test_random_turns_are_the_same_each_time_and_others_with_another_seed(self):
        def end(seed):
            return self.copy(random_turns_deg=5.0, seed=seed).poses[-1]

        self.assertEqual(end(1), end(1))
        self.assertNotEqual(end(1), end(2))
        self.assertNotAlmostEqual(end(1)[1][2], self.recording.poses[-1][1][2], places=2)

    def test_noise_is_a_random_walk_that_depends_on_the_seed_only(self):
        def end(**choices):
            return self.copy(**choices).poses[-1][1]

        self.assertEqual(end(noise=1.0, seed=1), end(noise=1.0, seed=1))
        self.assertNotEqual(end(noise=1.0, seed=1), end(noise=1.0, seed=2))
        off_m = math.dist(end(noise=1.0, seed=1)[:2], self.recording.poses[-1][1][:2])
        self.assertTrue(0.05 < off_m < 15.0, off_m)

    def test_dead_reckoning_leads_by_the_time_asked_for(self):
        straight = int(SIDE_M / STEP_M) // 2
        for self.recording in (self.recording, self.only_scans(0)):
            copy = self.copy(lead_s=0.5)
            self.assertEqual([stamp for stamp, _ in copy.poses], [stamp for stamp, _ in self.recording.poses])
            self.assertAlmostEqual(copy.poses[straight][1][0], (straight + 0.5) * STEP_M, places=4)
            self.assert_same_pose(copy.poses[-1][1], self.recording.poses[-1][1])

    def test_stamps_in_bunches_are_spread_evenly_before_a_lead(self):
        bunched = [float(i // 3 * 3) + i % 3 * 1e-3 for i in range(60)]
        times = changed.regular_times(bunched)
        self.assertTrue(all(0.8 < now - before < 1.2 for before, now in zip(times[11:48], times[12:49])))

    def test_regular_stamps_and_pauses_stay(self):
        stamps = [i * 0.2 + (60.0 if i >= 20 else 0.0) for i in range(40)]
        for time, stamp in zip(changed.regular_times(stamps), stamps):
            self.assertAlmostEqual(time, stamp, places=9)

    def test_a_cut_copy_has_the_scans_of_its_part_and_the_poses_around_them(self):
        scans = len(self.recording.scans)
        for self.recording in (self.recording, self.only_scans(0)):
            copy = self.copy(first=0.25, last=0.75)
            self.assertEqual([ranges[0] for _, ranges in copy.scans],
                             [str(i) for i in range(scans // 4, scans * 3 // 4)])
            self.assertLessEqual(abs(copy.poses[0][0] - copy.scans[0][0]), changed.AROUND_SCANS_S)
            self.assertLessEqual(abs(copy.poses[-1][0] - copy.scans[-1][0]), changed.AROUND_SCANS_S)
        self.assertEqual(self.copy(first=0.25, backwards=True).scans[0][1][0], str(scans * 3 // 4 - 1))
        with self.assertRaisesRegex(ValueError, "leaves no scan"):
            self.copy(first=1.0)

    def test_what_was_mapped_from_a_copy_is_led_back_to_the_log_s_stamps_and_sense(self):
        for choices in ({}, {"backwards": True}, {"mirrored": True}, {"backwards": True, "mirrored": True}):
            change = changed.Change("some", **choices)
            turned = changed.turned_round(self.recording, change)
            at = dict(zip(([t for t, _ in self.recording.scans]), (pose for _, pose in square())))
            mapped = self.folder / "mapped.tum"
            side = -1 if change.mirrored else 1
            rows = []
            for stamp, _ in turned.scans:
                was = self.recording.ends_s() - stamp if change.backwards else stamp
                x, y, yaw = at[min(at, key=lambda t: abs(t - was))]
                rows.append(f"{stamp + self.recording.scan_delay_s():.6f} {x} {side * y} 0 0 0 "
                            f"{math.sin(side * yaw / 2)} {math.cos(yaw / 2)}\n")
            mapped.write_text("# stamp x y z qx qy qz qw\n" + "".join(rows))
            back = self.folder / "back.tum"
            changed.lead_back(mapped, self.recording, change, back)
            found = [list(map(float, line.split())) for line in back.read_text().splitlines()]
            self.assertEqual(len(found), len(square()))
            for (stamp, x, y, _, _, _, qz, qw), (there, pose) in zip(found, square()):
                self.assertAlmostEqual(stamp, there, places=5)
                self.assert_same_pose((x, y, 2 * math.atan2(qz, qw)), pose)

    def test_a_log_without_scans_is_refused(self):
        with gzip.open(self.log, "wt") as file:
            file.write("ODOM 0 0 0 0 0 0 1 host 1\n")
        with self.assertRaisesRegex(ValueError, "holds no scan"):
            changed.read(self.log)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""tools/changed_capture.py changes a flight as it is asked to, and keeps the rest."""

import math
import struct
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools"))
sys.dont_write_bytecode = True
import changed_capture as changed  # noqa: E402
from changed_log import Change  # noqa: E402

VARIABLES = [("stateEstimateZ.x", 5), ("stateEstimateZ.y", 5), ("stateEstimateZ.vx", 5), ("stateEstimateZ.vy", 5),
             ("stateEstimate.qw", 7), ("stateEstimate.qx", 7), ("stateEstimate.qy", 7), ("stateEstimate.qz", 7),
             ("range.front", 2), ("range.left", 2), ("range.right", 2), ("pm.vbatMV", 2)]
BLOCKS = {1: [0, 1, 2, 3, 11], 2: [4, 5, 6, 7, 8, 9, 10]}
COUNT = 100  # packets of each block
FIRST_MS = (1 << 24) - 3000  # the clock wraps on the way


def record(stamp_s, header, said, from_vehicle=True):
    body = bytes([1, from_vehicle, *bytes(5), 80, 0, header]) + said
    return struct.pack("<IIII", int(stamp_s), round(stamp_s % 1 * 1e6), len(body), len(body)) + body


def flight():
    """A straight way to the left (yaw 90 deg), 0.1 m a packet."""
    file = bytes.fromhex("d4c3b2a1020004000000000000000000ffff0000a2000000")
    for number, (name, kind) in enumerate(VARIABLES):
        said = struct.pack("<BHB", 2, number, kind) + name.replace(".", "\0").encode() + b"\0"
        file += record(1000.0, 0x50, said)
    for block, numbers in BLOCKS.items():
        said = bytes([6, block]) + b"".join(struct.pack("<BH", VARIABLES[i][1], i) for i in numbers)
        file += record(1000.5, 0x5d, said, from_vehicle=False)
    half = math.sqrt(0.5)
    for i in range(COUNT):
        stamp = struct.pack("<I", (FIRST_MS + 100 * i) % (1 << 24))[:3]
        file += record(1001.0 + 0.1 * i, 0x52, b"\x01" + stamp + struct.pack("<hhhhH", 0, 100 * i, 0, 1000, 3900))
        said = struct.pack("<ffffHHH", half, 0, 0, half, 500 + i, 7, 8)
        file += record(1001.01 + 0.1 * i, 0x52, b"\x02" + stamp + said)
    return file


class ChangedCapture(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "flight.pcap").write_bytes(flight())

    def copy(self, **choices):
        changed.write(self.folder / "flight.pcap", Change("some", **choices), self.folder / "copy.pcap")
        return changed.Capture(self.folder / "copy.pcap")

    def last(self, name, **choices):
        return [packet.values[name] for packet in self.copy(**choices).packets if name in packet.values][-1]

    def test_a_copy_without_a_change_has_the_same_bytes(self):
        self.copy()
        self.assertEqual((self.folder / "copy.pcap").read_bytes(), flight())

    def test_the_clock_of_the_vehicle_is_unwrapped(self):
        stamps = [packet.at_ms for packet in self.copy().packets]
        self.assertEqual(stamps, sorted(stamps))
        self.assertEqual(stamps[-1] - stamps[0], 100 * (COUNT - 1))

    def test_mirrored_the_way_leads_to_the_right_and_left_ranges_are_right(self):
        self.assertEqual(self.last("stateEstimateZ.y", mirrored=True), -100 * (COUNT - 1))
        self.assertEqual(self.last("stateEstimateZ.vy", mirrored=True), -1000)
        self.assertAlmostEqual(self.last("stateEstimate.qz", mirrored=True), -math.sqrt(0.5), places=5)
        self.assertEqual((self.last("range.left", mirrored=True), self.last("range.right", mirrored=True)), (8, 7))

    def test_errors_of_dead_reckoning_are_those_asked_for(self):
        way_m = 0.1 * (COUNT - 1)
        self.assertEqual(self.last("stateEstimateZ.y", metres=1.1), round(1100 * way_m))
        attitude = {name: self.last(name, drift_deg_per_m=2.0) for name in changed.ATTITUDE}
        self.assertAlmostEqual(changed.yaw_of(attitude), math.pi / 2 + math.radians(2.0 * way_m), places=3)
        turned = math.radians(2.0 * way_m)
        self.assertAlmostEqual(self.last("stateEstimateZ.vx", drift_deg_per_m=2.0), -1000 * math.sin(turned), delta=1)
        self.assertLess(self.last("stateEstimateZ.x", drift_deg_per_m=2.0), -100)
        self.assertEqual(self.last("stateEstimateZ.x", noise=1.0, seed=3), self.last("stateEstimateZ.x", noise=1.0,
                                                                                     seed=3))
        self.assertNotEqual(self.last("stateEstimateZ.x", noise=1.0, seed=3), 0)

    def test_positions_lead_the_ranges(self):
        places = [packet.values["stateEstimateZ.y"] for packet in self.copy(lead_s=0.05).packets
                  if "stateEstimateZ.y" in packet.values]
        self.assertEqual(places[10], 1050)

    def test_a_cut_copy_keeps_the_handshake_and_the_stamps_of_what_stays(self):
        copy = self.copy(first=0.3, last=0.6)
        ranges = [packet.values["range.front"] for packet in copy.packets if "range.front" in packet.values]
        self.assertEqual((ranges[0], ranges[-1]), (530, 559))
        seconds, micros, _ = copy.records[copy.packets[0].record]
        self.assertAlmostEqual(seconds + micros * 1e-6, 1001.01 + 0.1 * 30, places=5)
        self.assertEqual(copy.records[0][0], 1000 + 3)
        self.assertEqual(copy.packets[0].record, len(VARIABLES) + len(BLOCKS))

    def test_what_is_not_possible_is_refused(self):
        for choices in ({"backwards": True}, {"first": 1.0}, {"metres": 5.0}):
            with self.assertRaises(ValueError):
                self.copy(**choices)
        (self.folder / "flight.pcap").write_bytes(flight()[:500])
        with self.assertRaises(ValueError):
            self.copy()


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Changed copies of captures of the radio (see docs/recording.md), as changed_log.py makes them of laser logs: cut
off, left and right exchanged, larger errors of dead reckoning. The handshake and all other variables stay."""

import dataclasses
import math
import struct
from pathlib import Path

import changed_log

FILE_HEADER = 24
RECORD_HEADER = struct.Struct("<IIII")  # seconds, microseconds, length kept, length
LOG_PORT = 5
TABLE, CONTROL, DATA = 0, 1, 2  # channels of the log port
ITEM, CREATE, APPEND = 2, 6, 7
FORMATS = {1: "B", 2: "H", 3: "I", 4: "b", 5: "h", 6: "i", 7: "f", 8: "e"}
WRAPS_MS = 1 << 24
TO_MIRROR = ["stateEstimateZ.vy", "stateEstimateZ.ay", "stateEstimateZ.rateRoll", "stateEstimateZ.rateYaw"]
TO_TURN = [("stateEstimateZ.vx", "stateEstimateZ.vy"), ("stateEstimateZ.ax", "stateEstimateZ.ay")]
POSITION = ("stateEstimateZ.x", "stateEstimateZ.y")
ATTITUDE = ("stateEstimate.qw", "stateEstimate.qx", "stateEstimate.qy", "stateEstimate.qz")
RANGE = "range.front"


@dataclasses.dataclass
class Packet:
    """Of log data: values by the variables' names."""
    record: int
    block: int
    at_ms: int  # since the vehicle's start, unwrapped
    values: dict


def records_of(data):
    """[(seconds, microseconds, body)]. A record that is not whole at the end is left out."""
    found, at = [], FILE_HEADER
    while at + RECORD_HEADER.size <= len(data):
        seconds, micros, length, _ = RECORD_HEADER.unpack_from(data, at)
        at += RECORD_HEADER.size
        if at + length > len(data):
            break
        found.append((seconds, micros, data[at:at + length]))
        at += length
    return found


class Capture:
    """Raises OSError, or ValueError where it is no capture of a radio that logs positions, attitude and ranges."""

    def __init__(self, path):
        data = Path(path).read_bytes()
        self.header = data[:FILE_HEADER]
        self.records = records_of(data)
        names, self.layouts = {}, {}
        self.packets = []
        for index, (_, _, body) in enumerate(self.records):
            if len(body) < 11 or body[0] != 1 or body[9] >> 4 != LOG_PORT:
                continue
            from_vehicle, channel, said = body[1] == 1, body[9] & 3, body[10:]
            if channel == TABLE and from_vehicle and said[0] == ITEM and len(said) > 4:
                names[said[1] | said[2] << 8] = ".".join(said[4:].decode("latin-1").split("\0")[:2])
            elif channel == CONTROL and not from_vehicle and said[0] in (CREATE, APPEND):
                self.describe(said, names)
            elif channel == DATA and from_vehicle and said[0] in self.layouts:
                self.packets.append(self.packet(index, said))
        logged = {name for layout in self.layouts.values() for name, _ in layout}
        if not self.packets or not {*POSITION, *ATTITUDE, RANGE} <= logged:
            raise ValueError(f"{path}: logs no position, attitude or ranges of the known kind")

    def describe(self, said, names):
        entries = [(names[said[i + 1] | said[i + 2] << 8], FORMATS[said[i] & 15]) for i in range(2, len(said) - 2, 3)]
        self.layouts[said[1]] = (self.layouts.get(said[1], []) if said[0] == APPEND else []) + entries

    def packet(self, index, said):
        layout = self.layouts[said[0]]
        at_ms = int.from_bytes(said[1:4], "little")
        if self.packets:  # less than half a turn of the clock from the one before
            last_ms = self.packets[-1].at_ms
            at_ms = last_ms + (at_ms - last_ms + WRAPS_MS // 2) % WRAPS_MS - WRAPS_MS // 2
        values = struct.unpack_from("<" + "".join(kind for _, kind in layout), said, 4)
        return Packet(index, said[0], at_ms, {name: value for (name, _), value in zip(layout, values)})

    def body(self, packet):
        """Of the packet's record, with its values."""
        old = self.records[packet.record][2]
        layout = self.layouts[packet.block]
        kinds = "<" + "".join(kind for _, kind in layout)
        try:
            values = struct.pack(kinds, *(packet.values[name] for name, _ in layout))
        except struct.error as error:
            raise ValueError(f"a changed value is beyond what the capture can hold: {error}") from error
        return old[:14] + values + old[14 + len(values):]


def yaw_of(values):
    w, x, y, z = (values[name] for name in ATTITUDE)
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def mirror(values):
    for name in (*TO_MIRROR, POSITION[1], ATTITUDE[1], ATTITUDE[3]):
        if name in values:
            values[name] = -values[name]
    if "range.left" in values and "range.right" in values:
        values["range.left"], values["range.right"] = values["range.right"], values["range.left"]


def turn(values, by_rad):
    """About the vertical."""
    c, s = math.cos(by_rad), math.sin(by_rad)
    for name_x, name_y in TO_TURN:
        if name_x in values and name_y in values:
            x, y = values[name_x], values[name_y]
            values[name_x], values[name_y] = round(c * x - s * y), round(s * x + c * y)
    if ATTITUDE[0] in values:
        w, x, y, z = (values[name] for name in ATTITUDE)
        c, s = math.cos(by_rad / 2.0), math.sin(by_rad / 2.0)
        values.update(zip(ATTITUDE, (c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w)))


def kept_span(capture, change):
    """First and last index of the records of log data that stay."""
    scans = [packet.record for packet in capture.packets if RANGE in packet.values]
    kept = scans[round(change.first * len(scans)):round(change.last * len(scans))]
    if not kept:
        raise ValueError(f"{change.name}: leaves no scan")
    first = capture.packets[0].record if change.first == 0.0 else kept[0]
    return first, len(capture.records) if change.last == 1.0 else kept[-1]


def drive_otherwise(packets, change):
    """Changes positions and attitudes as the change has it."""
    if change.mirrored:
        for packet in packets:
            mirror(packet.values)
    attitudes = [packet for packet in packets if ATTITUDE[0] in packet.values]
    yaws = [(packet.at_ms * 1e-3, (0.0, 0.0, yaw_of(packet.values))) for packet in attitudes]
    stamps = [stamp for stamp, _ in yaws]
    places = [packet for packet in packets if POSITION[0] in packet.values]
    before = []
    for packet in places:
        stamp = packet.at_ms * 1e-3
        x_m, y_m = (packet.values[name] * 1e-3 for name in POSITION)
        before.append((stamp, (x_m, y_m, changed_log.pose_at(stamps, yaws, stamp)[2])))
    after = changed_log.with_errors(changed_log.ahead(before, change.lead_s), change)
    turns = [(stamp, (0.0, 0.0, changed_log.wrapped(new[2] - old[2]))) for (stamp, old), (_, new) in zip(before, after)]
    for packet, (_, (x_m, y_m, _)) in zip(places, after):
        packet.values.update(zip(POSITION, (round(x_m * 1e3), round(y_m * 1e3))))
    at = [stamp for stamp, _ in turns]
    for packet in packets:
        turn(packet.values, changed_log.pose_at(at, turns, packet.at_ms * 1e-3)[2])


def write(source, change, target):
    """Writes the changed copy. Raises as Capture does, ValueError also where the change is none for captures."""
    if change.backwards:
        raise ValueError("a capture is not played backwards")
    capture = Capture(source)
    first, last = kept_span(capture, change)
    kept = [packet for packet in capture.packets if first <= packet.record <= last]
    drive_otherwise(kept, change)
    bodies = {packet.record: capture.body(packet) for packet in kept}
    handshake_end = capture.packets[0].record
    later_s = capture.records[first][0] - capture.records[handshake_end][0]
    with open(target, "wb") as file:
        file.write(capture.header)
        for index, (seconds, micros, body) in enumerate(capture.records):
            if handshake_end <= index < first or index > last:
                continue
            moved_s = later_s if index < handshake_end else 0
            body = bodies.get(index, body)
            file.write(RECORD_HEADER.pack(seconds + moved_s, micros, len(body), len(body)) + body)


def lead_back(trajectory, change, target):
    """Transforms a trajectory (TUM) mapped from the changed copy to one of the flight, and writes it."""
    changed_log.lead_back(trajectory, changed_log.Recording([], [], True), change, target)

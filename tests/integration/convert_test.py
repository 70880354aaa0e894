#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""swiftlet convert as its users run it. Usage: convert_test.py CASE SWIFTLET SWIFTLETD"""

import base64
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from mcap_reader import Mcap, conforms

INPUT = "sim://office?seed=1"


def swiftlet(*arguments):
    return subprocess.run([sys.argv[2], *map(str, arguments)], capture_output=True, text=True, check=True)


def converted(folder, name="run.mcap"):
    swiftlet("convert", INPUT, folder / name)
    return (folder / name).read_bytes()


def check_that_times_begin_with_the_first_pose(mcap):
    first_ns = mcap.messages["/pose"][0][0]
    early = {topic: messages[0] for topic, messages in mcap.messages.items() if messages and messages[0][0] < first_ns}
    assert not early, early


def yaw_of(rotation):
    return 2 * math.atan2(rotation["z"], rotation["w"])


def tum_lines(path):
    """(stamp in us, x, y, z and w of the rotation) of each line, as the file's text has them."""
    for line in path.read_text().splitlines():
        stamp, x, y, _, _, _, qz, qw = line.split()
        seconds, micro = stamp.split(".")
        yield int(seconds) * 1_000_000 + int(micro), x, y, qz, qw


def as_tum(message):
    time_ns, content = message
    stamp = content["timestamp"]
    assert stamp["sec"] * 10**9 + stamp["nsec"] == time_ns, "times of message and content differ"
    position, rotation = content["pose"]["position"], content["pose"]["orientation"]
    return time_ns // 1000, *(f"{position[c]:.6f}" for c in "xy"), *(f"{rotation[c]:.9f}" for c in "zw")


def an_mcap_of_a_flight_holds_the_trajectory_that_map_writes(folder):
    mcap = Mcap(converted(folder))
    swiftlet("map", INPUT, "-o", folder / "map")
    for topic, name in (("/trajectory", "trajectory.tum"), ("/pose", "live.tum"), ("/pose_odom", "odometry.tum")):
        lines = list(tum_lines(folder / "map" / name))
        poses = [as_tum(message) for message in mcap.messages[topic]]
        assert len(poses) == len(lines) > 1000, (topic, len(poses), len(lines))
        different = [(pose, line) for pose, line in zip(poses, lines) if pose != line]
        assert not different, (topic, len(different), different[:3])


def an_mcap_is_what_its_schemas_say_and_the_same_each_time(folder):
    data = converted(folder)
    assert data == converted(folder, "again.mcap"), "other bytes of the same flight"
    mcap = Mcap(data)
    check_that_times_begin_with_the_first_pose(mcap)
    for topic, schema in mcap.channels.values():
        name, content = mcap.schemas[schema]
        assert content["title"] == name
        assert mcap.messages[topic], f"{topic} is empty"
        wrong = [message for _, message in mcap.messages[topic] if not conforms(message, content)]
        assert not wrong, (topic, wrong[0])


def the_map_in_an_mcap_is_the_map_that_map_writes(folder):
    _, grid = Mcap(converted(folder)).messages["/map"][-1]
    cells = [cell - 256 if cell > 127 else cell for cell in base64.b64decode(grid["data"])]
    swiftlet("map", INPUT, "-o", folder / "map")
    magic, size, depth, pixels = (folder / "map" / "map.pgm").read_bytes().split(b"\n", 3)
    columns, rows = map(int, size.split())
    assert (magic, depth, grid["column_count"], grid["row_stride"]) == (b"P5", b"255", columns, columns)
    assert len(cells) == columns * rows
    shade = [205 if c < 0 or 45 <= c < 65 else 0 if c >= 65 else 254 for c in cells]
    rows_from_below = [pixels[row * columns : (row + 1) * columns] for row in reversed(range(rows))]
    assert bytes(shade) == b"".join(rows_from_below), "another map"
    origin = next(line for line in (folder / "map" / "map.yaml").read_text().splitlines() if "origin" in line)
    x, y, _ = (float(number) for number in origin.split("[")[1].rstrip("]").split(","))
    assert math.isclose(grid["pose"]["position"]["x"], x, abs_tol=1e-6), (grid["pose"], origin)
    assert math.isclose(grid["pose"]["position"]["y"], y, abs_tol=1e-6), (grid["pose"], origin)


def transforms_in_an_mcap_lead_to_the_poses(folder):
    messages = Mcap(converted(folder)).messages
    for (_, tf), (_, pose) in zip(messages["/tf"], messages["/pose"]):
        to_local, to_body, to_odom = tf["transforms"]
        frames = [(t["parent_frame_id"], t["child_frame_id"]) for t in tf["transforms"]]
        assert frames == [("map", "local"), ("local", "body"), ("map", "odom")]
        yaw, shift = yaw_of(to_local["rotation"]), to_body["translation"]
        x = to_local["translation"]["x"] + math.cos(yaw) * shift["x"] - math.sin(yaw) * shift["y"]
        y = to_local["translation"]["y"] + math.sin(yaw) * shift["x"] + math.cos(yaw) * shift["y"]
        position = pose["pose"]["position"]
        assert math.hypot(position["x"] - x, position["y"] - y) < 1e-9
        turned = yaw + yaw_of(to_body["rotation"]) - yaw_of(pose["pose"]["orientation"])
        assert abs(math.remainder(turned, 2 * math.pi)) < 1e-9
        assert to_odom == {**to_odom, "translation": messages["/tf"][0][1]["transforms"][2]["translation"]}


def the_messages_of_a_daemon_become_an_mcap_until_its_run_ends(folder):
    log = f"file://{folder}/run.lcm"
    subprocess.run([sys.argv[3], "--input", INPUT, "--rate", "1e6", "--lcm-url", log + "?mode=w", "-o", folder / "out"],
                   capture_output=True, check=True)
    said = swiftlet("convert", "lcm:", folder / "run.mcap", "--lcm-url", log + "?speed=0")
    assert said.stdout.startswith("listening on file://"), said.stdout
    mcap = Mcap((folder / "run.mcap").read_bytes())
    check_that_times_begin_with_the_first_pose(mcap)
    flown = [stamp for stamp, *_ in tum_lines(folder / "out" / "live.tum")]
    received = [time_ns // 1000 for time_ns, _ in mcap.messages["/pose"]]
    unpublished = sorted(set(flown) - set(received))  # a replay this fast can outrun the publisher on a busy machine
    queues = json.loads((folder / "out" / "report.json").read_text())["queues"]
    assert len(unpublished) == queues["poses"]["refused"], (len(unpublished), queues)
    assert received == [stamp for stamp in flown if stamp not in unpublished]
    assert not mcap.messages["/trajectory"]
    _, last = mcap.messages["/status"][-1]
    assert last["message"].startswith("finished: "), last


def a_log_that_breaks_off_ends_convert_and_latency(folder):
    log = folder / "run.lcm"
    subprocess.run([sys.argv[3], "--input", INPUT, "--rate", "1e6", "--lcm-url", f"file://{log}?mode=w", "--no-output"],
                   capture_output=True, check=True)
    log.write_bytes(log.read_bytes()[: log.stat().st_size // 2])
    swiftlet("convert", "lcm:", folder / "run.mcap", "--lcm-url", f"file://{log}?speed=0")
    assert Mcap((folder / "run.mcap").read_bytes()).messages["/pose"]
    swiftlet("latency", "--listen", "--lcm-url", f"file://{log}?speed=0")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        globals()[sys.argv[1]](Path(name))

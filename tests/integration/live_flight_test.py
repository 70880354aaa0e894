#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""swiftletd live on a vehicle that misbehaves: `swiftlet sim` over UDP.

live_flight_test.py CASE SWIFTLETD SWIFTLET. CASE is the name of one of the functions below.
"""

import os
import re
import signal
import socket
import subprocess
import sys
import time

from flight_bench import run_case
from simulation import PATIENCE_S, RegisteringDoor, expect


def longest_hole_s(stamps):
    return max(after - before for before, after in zip(stamps, stamps[1:]))


def the_recording_replays_to_the_same_samples(bench):
    vehicle = bench.vehicle("--seed", "7")
    flight = bench.flight(vehicle.port)
    flight.wait_for("connected to the vehicle")
    time.sleep(8.0)
    report, stamps = flight.land()
    vehicle.end()
    expect(len(stamps) >= 70 and report["segments"] == 1, report)
    expect(report["gaps"] == 0 and report["duplicates"] == 0, report)
    flight.expect_replay_to_be_the_same()


def a_silence_of_three_seconds_is_one_gap_and_the_map_is_kept(bench):
    vehicle = bench.vehicle()
    flight = bench.flight(vehicle.port)
    flight.wait_for("connected to the vehicle")
    time.sleep(3.0)
    vehicle.type("silence 3")
    flight.wait_for("no log data for a second")
    flight.wait_for("connected to the vehicle", times=2)
    time.sleep(3.0)
    report, stamps = flight.land()
    vehicle.end()
    expect(report["gaps"] == 1 and report["segments"] == 2, report)
    expect(3.0 <= longest_hole_s(stamps) < 5.0, f"a hole of {longest_hole_s(stamps)} s")
    flight.expect_replay_to_be_the_same()


def a_reboot_is_one_gap_and_the_map_is_kept(bench):
    vehicle = bench.vehicle()
    flight = bench.flight(vehicle.port)
    flight.wait_for("connected to the vehicle")
    time.sleep(3.0)
    vehicle.type("reboot")
    flight.wait_for("the vehicle has rebooted")
    time.sleep(2.0)
    report, stamps = flight.land()
    vehicle.end()
    expect(report["gaps"] == 1 and report["segments"] == 2, report)
    expect(longest_hole_s(stamps) < 4.0 + 2.0, f"a hole of {longest_hole_s(stamps)} s")
    flight.expect_replay_to_be_the_same()


def another_vehicle_at_the_same_address_goes_on(bench):
    """The battery was changed: nobody answers for a while, then the clock and the dead reckoning are new."""
    vehicle = bench.vehicle()
    flight = bench.flight(vehicle.port)
    flight.wait_for("connected to the vehicle")
    time.sleep(2.0)
    vehicle.end()
    flight.wait_for("the vehicle does not answer")
    time.sleep(1.0)
    vehicle = bench.vehicle(port=vehicle.port)
    flight.wait_for("connected to the vehicle", times=2)
    time.sleep(2.0)
    report, _ = flight.land()
    vehicle.end()
    expect(report["gaps"] == 1 and report["segments"] == 2, report)
    flight.expect_replay_to_be_the_same()


def waits_for_a_vehicle_that_is_switched_on_later(bench):
    first = bench.vehicle()
    first.end()
    flight = bench.flight(first.port)
    flight.wait_for("the vehicle does not answer")
    vehicle = bench.vehicle(port=first.port)
    flight.wait_for("connected to the vehicle")
    time.sleep(2.0)
    report, stamps = flight.land()
    vehicle.end()
    expect(len(stamps) > 10 and report["gaps"] == 0, report)


def the_wrap_of_the_vehicles_clock_goes_unnoticed(bench):
    vehicle = bench.vehicle("--clock-start", "16773.5")  # 24 bits of milliseconds end at 16777.216
    flight = bench.flight(vehicle.port)
    flight.wait_for("connected to the vehicle")
    time.sleep(6.0)
    report, _ = flight.land()
    vehicle.end()
    expect(report["gaps"] == 0 and report["segments"] == 1, report)
    flight.expect_replay_to_be_the_same()


def a_recording_is_followed_while_it_is_written(bench):
    vehicle = bench.vehicle("--seed", "7")
    flight = bench.flight(vehicle.port)
    flight.wait_for("connected to the vehicle")
    out = bench.folder / "followed"
    notices = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    notices.bind(str(bench.folder / "notices"))
    notices.settimeout(PATIENCE_S)
    follower = subprocess.Popen([bench.swiftletd, "--input", f"follow:{flight.recording}", "--lcm-url", "memq://",
                                 "-o", str(out)], stderr=subprocess.PIPE, text=True,
                                env=dict(os.environ, NOTIFY_SOCKET=notices.getsockname()))

    def samples_followed():
        told = re.match(rb"STATUS=(\d+) samples", notices.recv(4096))
        return int(told[1]) if told else 0

    while samples_followed() <= 60:
        pass
    _, stamps = flight.land()
    vehicle.end()
    while samples_followed() < len(stamps):
        pass
    expect(follower.poll() is None, "the follower ended by itself")
    follower.send_signal(signal.SIGTERM)
    said = follower.communicate(timeout=60)[1]
    expect(follower.returncode == 0 and len(stamps) > 60, said)
    for name in ("trajectory.tum", "odometry.tum", "map.pgm"):
        expect((out / name).read_bytes() == (flight.out / name).read_bytes(), name + " differs: " + said)


def each_program_says_goodbye_to_a_simulator_that_serves_one(bench):
    vehicle = bench.vehicle()
    door = RegisteringDoor(vehicle.port)
    try:
        for _ in range(2):
            asked = subprocess.run([bench.swiftlet, "doctor", f"udp://127.0.0.1:{door.port}", "--json"],
                                   capture_output=True, check=False, text=True)
            expect("all variables are there and log data flows" in asked.stdout, asked.stdout)
        recorded = subprocess.run([bench.swiftlet, "record", f"udp://127.0.0.1:{door.port}", "--seconds", "3", "-o",
                                   str(bench.folder / "recorded.pcap")], capture_output=True, check=False, text=True)
        expect(recorded.returncode == 0, recorded.stderr)
        flight = bench.flight(door.port)
        flight.wait_for("connected to the vehicle")
        time.sleep(2.0)
        _, stamps = flight.land()
        expect(len(stamps) > 10, f"{len(stamps)} samples")
        expect(door.client is None, "the daemon never said goodbye")
    finally:
        door.close()
        vehicle.end()


def a_missing_deck_is_named(bench):
    vehicle = bench.vehicle("--missing-deck", "multiranger")
    flight = bench.flight(vehicle.port)
    flight.wait_for("no Multiranger deck")
    vehicle.end()
    flight.process.kill()
    flight.process.wait()


if __name__ == "__main__":
    sys.exit(run_case(globals(), *sys.argv[1:]))

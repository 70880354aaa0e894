#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""swiftletd --share as its users run it: `swiftlet sim` is the vehicle, and a client connects to the daemon as strictly
as the vendor's does.

shared_flight_test.py CASE SWIFTLETD SWIFTLET. CASE is the name of one of the functions below.
"""

import socket
import struct
import subprocess
import sys
import tempfile
import time

from flight_bench import Bench, Flight, run_case
from simulated_vehicle_client_test import COMMANDER_GENERIC, Client
from simulation import Simulation, expect

NAMES = ["stateEstimate.x", "stateEstimate.y", "stateEstimate.yaw"]


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class SharedFlight(Flight):
    """swiftletd on a vehicle, sharing and recording."""

    def __init__(self, bench, vehicle_port):
        self.port = free_port()
        super().__init__(bench, vehicle_port, "--share", f"udp://127.0.0.1:{self.port}")


def steered(bench):
    return Simulation(bench.swiftlet, "--world", "loop", "--steered")


def begin(bench, vehicle):
    flight = SharedFlight(bench, vehicle.port)
    flight.wait_for("connected to the vehicle")
    return flight


def hover(client, forward, yaw_rate_deg, seconds):
    """Setpoints at 50 Hz; what comes meanwhile is counted by the client."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        client.send(COMMANDER_GENERIC, 0, struct.pack("<Bffff", 10, forward, 0.0, yaw_rate_deg, 0.5))
        client.receive(0.02)


def a_client_flies_while_the_map_is_made(bench):
    vehicle = steered(bench)
    flight = begin(bench, vehicle)
    client = Client(flight.port).connect()
    flight.wait_for("a client has connected")
    client.start_block(1, NAMES)
    hover(client, 0.0, 0.0, 3.0)
    vehicle.wait_for("took off")
    hover(client, 0.4, 0.0, 4.0)
    hover(client, 0.0, 45.0, 4.0)
    x = [values[0] for _, values in client.samples(1, NAMES, 0.5)]
    expect(x and max(x) > 1.0, f"it did not fly: {x}")
    report, stamps = flight.land()
    vehicle.end()
    expect(report["gaps"] == 0 and report["segments"] == 1 and report["duplicates"] == 0, report)
    expect(len(stamps) >= 100, f"{len(stamps)} samples")
    flight.expect_replay_to_be_the_same()


def a_killed_client_leaves_the_map_and_another_may_come(bench):
    vehicle = steered(bench)
    flight = begin(bench, vehicle)
    first = Client(flight.port).connect()
    first.start_block(1, NAMES)
    first.send(5, 0, struct.pack("<BH", 2, 3))
    first.socket.close()
    flight.wait_for("the client is gone")
    second = Client(flight.port).connect()
    second.start_block(1, NAMES)
    expect(len(second.samples(1, NAMES, 1.0)) >= 8, "no data for the second client")
    report, _ = flight.land()
    vehicle.end()
    expect(report["gaps"] == 0 and report["segments"] == 1, report)
    flight.expect_replay_to_be_the_same()


def a_second_client_is_refused_in_one_line(bench):
    vehicle = steered(bench)
    flight = begin(bench, vehicle)
    first = Client(flight.port).connect()
    second = Client(flight.port)
    for _ in range(5):
        second.send(15, 1, [0])
    expect(second.receive(0.5) is None, "the second client is answered")
    expect(first.ask(15, 0, [7]) == bytes([7]), "the first client is not answered")
    flight.wait_for("a second client, from port")
    time.sleep(1.5)
    expect(flight.said().count("a second client") == 1, flight.said())
    flight.land()
    vehicle.end()


def a_client_is_told_of_the_end(bench):
    vehicle = steered(bench)
    flight = begin(bench, vehicle)
    client = Client(flight.port).connect()
    client.unasked.clear()
    flight.land()
    while packet := client.receive(0.2):
        client.unasked.append(packet)
    expect("swiftletd has ended" in client.console(), "the client was not told")
    try:
        client.send(15, 0, [1])
        time.sleep(0.1)
        client.send(15, 0, [1])
        expect(False, "a client sends to nobody and is not told")
    except ConnectionRefusedError:
        pass
    vehicle.end()


def a_second_swiftletd_may_be_the_client(bench):
    vehicle = Simulation(bench.swiftlet, "--world", "loop")
    flight = begin(bench, vehicle)
    with tempfile.TemporaryDirectory() as folder:
        other = Flight(Bench(bench.swiftletd, bench.swiftlet, folder), flight.port)
        other.wait_for("connected to the vehicle")
        time.sleep(5.0)
        report, stamps = other.land()
        expect(len(stamps) > 40 and report["gaps"] == 0, report)
        other.expect_replay_to_be_the_same()
    report, _ = flight.land()
    vehicle.end()
    expect(report["gaps"] == 0 and report["segments"] == 1, report)
    flight.expect_replay_to_be_the_same()


def refuses_what_cannot_be_shared(bench):
    def refusal(*options):
        done = subprocess.run([bench.swiftletd, "--lcm-url", "memq://", *options], capture_output=True, text=True,
                              timeout=20, check=False)
        expect(done.returncode == 2, f"{options}: exit code {done.returncode}, {done.stderr}")
        return done.stderr

    expect("only the link to a live vehicle" in refusal("--input", "sim://loop", "--share"), "a simulation")
    expect("udp://127.0.0.1:19850" in refusal("--input", "udp://127.0.0.1:1", "--no-record", "--share", "tcp://x"),
           "no UDP")
    expect("not an IPv4 address" in refusal("--input", "udp://127.0.0.1:1", "--no-record", "--share", "udp://pilot"),
           "a name")
    for vehicle, share in (("127.0.0.1", ()), ("127.0.0.1", ("udp://localhost",)), ("localhost", ()),
                           ("192.0.2.1", ("udp://0.0.0.0:19850",))):
        expect("INPUT is at that port" in refusal("--input", f"udp://{vehicle}:19850", "--no-record", "--share", *share),
               f"its own client: {vehicle}, {share}")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
        expect("another program has it" in refusal("--input", "udp://127.0.0.1:1", "--no-record", "--share",
                                                   f"udp://127.0.0.1:{port}"), "a port in use")


if __name__ == "__main__":
    sys.exit(run_case(globals(), *sys.argv[1:]))

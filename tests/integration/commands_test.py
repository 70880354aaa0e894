#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""swiftletd --commands and `swiftlet tell`, live on `swiftlet sim`; and that without the option nothing listens.

commands_test.py CASE SWIFTLETD SWIFTLET. CASE is the name of one of the functions below.
"""

import csv
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

from flight_bench import run_case
from shared_flight_test import free_port
from simulated_vehicle_client_test import Client
from simulation import PATIENCE_S, expect

LOOPBACK = 'ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo && exec "$@"'
TCP_LISTEN = "0A"
LCM_PORT = 7667
NO_NAMESPACE = 77


def commanded_flight(bench, vehicle, *options, **lcm):
    flight = bench.flight(vehicle.port, "--commands", "127.0.0.1:0", *options, **lcm)
    flight.wait_for("commands are taken on")
    flight.wait_for("connected to the vehicle")
    return flight


def tell(bench, flight, *words):
    """To the newest run."""
    port = re.findall(r"commands are taken on tcpq://127\.0\.0\.1:(\d+)", flight.said())[-1]
    return subprocess.run([bench.swiftlet, "tell", *words, "--to", f"127.0.0.1:{port}"], capture_output=True, text=True,
                          check=False)


def a_place_is_marked_and_the_map_saved_while_the_flight_goes_on(bench):
    vehicle = bench.vehicle()
    flight = commanded_flight(bench, vehicle)
    time.sleep(3.0)
    expect(tell(bench, flight, "mark-place", "kitchen").returncode == 0, flight.said())
    flight.wait_for("place kitchen marked")
    expect(tell(bench, flight, "save-map").returncode == 0, flight.said())
    flight.wait_for("map saved")
    expect((flight.out / "map.pgm").read_bytes().startswith(b"P5"), "no map")
    expect(not (flight.out / "report.json").exists(), "the run has ended")
    _, stamps = flight.land()
    vehicle.end()
    with open(flight.out / "places.csv", encoding="utf-8") as file:
        place, = csv.DictReader(file)
    expect(place["name"] == "kitchen", place)
    expect(any(abs(float(place["time_s"]) - stamp) < 1e-6 for stamp in stamps), f"{place} is at no sample")


def a_new_map_is_a_run_of_its_own(bench):
    vehicle = bench.vehicle()
    flight = commanded_flight(bench, vehicle, lcm_url=f"file://{bench.folder}/run.lcm?mode=w")
    time.sleep(2.0)
    expect(tell(bench, flight, "new-map").returncode == 0, flight.said())
    flight.wait_for("commands are taken on", times=2)
    flight.wait_for("connected to the vehicle", times=2)
    time.sleep(2.0)
    flight.process.send_signal(signal.SIGTERM)
    expect(flight.process.wait(timeout=60) == 0, flight.said())
    vehicle.end()
    for name in ("out", "out_2"):
        report = json.loads((bench.folder / name / "report.json").read_text(encoding="utf-8"))
        expect(report["run_peak_memory_mb"] > 1.0, f"{name}: {report['run_peak_memory_mb']} MB")
    stamps = [[float(line.split()[0]) for line in (bench.folder / name / "trajectory.tum").read_text().splitlines()]
              for name in ("out", "out_2")]
    expect(all(len(run) > 5 for run in stamps), [len(run) for run in stamps])
    expect(stamps[0][-1] < stamps[1][0], "the second run holds samples of the first")
    for name in ("flight_2.pcap", "run.lcm", "run_2.lcm"):
        expect((bench.folder / name).stat().st_size > 1000, sorted(os.listdir(bench.folder)))


def a_new_map_takes_names_that_are_free_and_waits_for_what_is_not(bench):
    another_days = [bench.folder / "flight_2.pcap", bench.folder / "run_3.lcm"]
    for file in another_days:
        file.write_bytes(b"of another day")
    in_the_way = bench.folder / "out_4"
    in_the_way.write_text("no folder", encoding="utf-8")
    vehicle = bench.vehicle()
    flight = commanded_flight(bench, vehicle, lcm_url=f"file://{bench.folder}/run.lcm?mode=w")
    time.sleep(1.0)
    expect(tell(bench, flight, "new-map").returncode == 0, flight.said())
    flight.wait_for("the next run cannot begin")
    time.sleep(2.5)
    expect(flight.said().count("the next run cannot begin") == 1, flight.said())
    in_the_way.unlink()
    flight.wait_for("connected to the vehicle", times=2)
    time.sleep(2.0)
    flight.process.send_signal(signal.SIGTERM)
    expect(flight.process.wait(timeout=60) == 0, flight.said())
    vehicle.end()
    expect((in_the_way / "report.json").exists(), sorted(os.listdir(bench.folder)))
    for name in ("flight_4.pcap", "run_4.lcm"):
        expect((bench.folder / name).stat().st_size > 1000, sorted(os.listdir(bench.folder)))
    expect(all(file.read_bytes() == b"of another day" for file in another_days), "overwritten")


def no_new_map_is_begun_for_who_ends_the_daemon(bench):
    in_the_way = bench.folder / "out_2"
    in_the_way.write_text("no folder", encoding="utf-8")
    vehicle = bench.vehicle()
    flight = commanded_flight(bench, vehicle, lcm_url=f"file://{bench.folder}/run.lcm?mode=w")
    time.sleep(1.0)
    expect(tell(bench, flight, "new-map").returncode == 0, flight.said())
    flight.wait_for("the next run cannot begin")
    in_the_way.unlink()
    flight.process.send_signal(signal.SIGTERM)
    expect(flight.process.wait(timeout=60) == 0, flight.said())
    vehicle.end()
    expect(flight.said().count("publishing on") == 1, flight.said())
    expect(not (bench.folder / "run_2.lcm").exists(), "a second run was published")


def a_new_map_leaves_another_days_results_alone(bench):
    another_days = bench.folder / "out_2" / "report.json"
    another_days.parent.mkdir()
    another_days.write_text("{}", encoding="utf-8")
    vehicle = bench.vehicle()
    flight = commanded_flight(bench, vehicle)
    time.sleep(1.0)
    expect(tell(bench, flight, "new-map").returncode == 0, flight.said())
    flight.wait_for("connected to the vehicle", times=2)
    time.sleep(2.0)
    flight.process.send_signal(signal.SIGTERM)
    expect(flight.process.wait(timeout=60) == 0, flight.said())
    vehicle.end()
    expect(another_days.read_text(encoding="utf-8") == "{}" and len(os.listdir(another_days.parent)) == 1, "replaced")
    expect((bench.folder / "out_3" / "report.json").exists(), sorted(os.listdir(bench.folder)))


def a_new_map_does_not_cut_off_a_client(bench):
    vehicle = bench.vehicle()
    share = free_port()
    flight = commanded_flight(bench, vehicle, "--share", f"udp://127.0.0.1:{share}")
    Client(share).connect()
    flight.wait_for("a client has connected")
    time.sleep(1.0)
    expect(tell(bench, flight, "new-map").returncode == 0, flight.said())
    flight.wait_for("no new map is begun: it would cut off")
    flight.land()
    vehicle.end()
    expect(not (bench.folder / "out_2").exists(), sorted(os.listdir(bench.folder)))


def the_exit_code_is_the_worst_of_all_runs(bench):
    vehicle = bench.vehicle()
    vehicle.end()
    flight = bench.flight(vehicle.port, "--commands", "127.0.0.1:0")
    flight.wait_for("commands are taken on")
    expect(tell(bench, flight, "new-map").returncode == 0, flight.said())
    flight.wait_for("held no usable sample")
    vehicle = bench.vehicle(port=vehicle.port)
    flight.wait_for("connected to the vehicle")
    time.sleep(2.0)
    flight.process.send_signal(signal.SIGTERM)
    expect(flight.process.wait(timeout=60) == 2, flight.said())
    vehicle.end()
    expect((bench.folder / "out_2" / "trajectory.tum").exists(), sorted(os.listdir(bench.folder)))


def what_cannot_be_is_told_in_one_line(bench):
    for words, why in ((["mark-place"], "1 to 60 bytes"), (["mark-place", "a,b"], "1 to 60 bytes"),
                       (["save-map", "kitchen"], "takes no name"), (["save-map"], "start swiftletd with --commands")):
        done = subprocess.run([bench.swiftlet, "tell", *words, "--to", "127.0.0.1:1"], capture_output=True, text=True,
                              check=False)
        expect(done.returncode == 2 and why in done.stderr, f"{words}: {done}")
    for address in ("0.0.0.0:8450", "192.0.2.1:8450"):
        done = subprocess.run([bench.swiftletd, "sim://patrol", "--no-output", "--lcm-url", "memq://", "--commands", address],
                              capture_output=True, text=True, check=False, timeout=PATIENCE_S)
        expect(done.returncode == 2 and "from this machine alone" in done.stderr, f"{address}: {done}")


def sockets_of(process, table):
    """(port, state) of each socket in the process's network."""
    rows = Path(f"/proc/{process.pid}/net/{table}").read_text(encoding="ascii").splitlines()[1:]
    return [(int(row.split()[1].rsplit(":", 1)[1], 16), row.split()[3]) for row in rows]


def without_the_option_nothing_listens(bench):
    namespace = ["unshare", "--net"] + ([] if os.geteuid() == 0 else ["--user", "--map-root-user"])
    if subprocess.run([*namespace, "--", "sh", "-c", LOOPBACK, "sh", "true"], capture_output=True,
                      check=False).returncode != 0:
        print("skipped: no network of its own is permitted here")
        sys.exit(NO_NAMESPACE)
    for options, listening in (((), 0), (("--commands",), 1)):
        with subprocess.Popen([*namespace, "--", "sh", "-c", LOOPBACK, "sh", bench.swiftletd, "sim://patrol", "--no-output",
                               *options], stderr=subprocess.PIPE, text=True) as daemon:
            expect(any("publishing on" in line for line in daemon.stderr), "nothing is published")
            time.sleep(1.0)
            tcp = [port for port, state in sockets_of(daemon, "tcp") + sockets_of(daemon, "tcp6") if state == TCP_LISTEN]
            udp = [port for port, _ in sockets_of(daemon, "udp") + sockets_of(daemon, "udp6")]
            daemon.send_signal(signal.SIGTERM)
            daemon.communicate(timeout=PATIENCE_S)
        expect(len(tcp) == listening and LCM_PORT not in udp, f"{options}: TCP {tcp}, UDP {udp}")


if __name__ == "__main__":
    sys.exit(run_case(globals(), *sys.argv[1:]))

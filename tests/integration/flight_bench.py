# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""swiftletd and `swiftlet sim` under a test's control, and a program of such tests."""

import json
import os
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from simulation import PATIENCE_S, Failed, Simulation, expect


class Flight:
    """swiftletd on a vehicle, recording."""

    def __init__(self, bench, port, *options, lcm_url="memq://"):
        self.folder, self.swiftlet = bench.folder, bench.swiftlet
        self.out, self.recording = self.folder / "out", self.folder / "flight.pcap"
        environment = dict(os.environ, XDG_CACHE_HOME=str(self.folder / "cache"))
        self.log = open(self.folder / "daemon.log", "w+", encoding="utf-8")
        self.process = subprocess.Popen(
            [bench.swiftletd, "--input", f"udp://127.0.0.1:{port}", "--lcm-url", lcm_url, "-o", f"{self.out}/",
             "--record", str(self.recording), *options], stderr=self.log, env=environment)

    def said(self):
        return (self.folder / "daemon.log").read_text(encoding="utf-8")

    def wait_for(self, words, times=1):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            expect(self.process.poll() is None, "the daemon ended by itself: " + self.said())
            if self.said().count(words) >= times:
                return
            time.sleep(0.05)
        raise Failed(f"the daemon never said {words!r}: {self.said()}")

    def land(self):
        """Stops the daemon: (input part of the report, stamps of all samples)."""
        self.process.send_signal(signal.SIGTERM)
        expect(self.process.wait(timeout=60) == 0, self.said())
        report = json.loads((self.out / "report.json").read_text(encoding="utf-8"))
        lines = (self.out / "trajectory.tum").read_text(encoding="utf-8").splitlines()
        return report["input"], [float(line.split()[0]) for line in lines if not line.startswith("#")]

    def expect_replay_to_be_the_same(self):
        again = self.folder / "again"
        done = subprocess.run([self.swiftlet, "map", str(self.recording), "--no-calibrate", "-o", str(again)],
                              capture_output=True, check=False)
        expect(done.returncode == 0, done.stderr.decode())
        for name in ("trajectory.tum", "odometry.tum", "map.pgm"):
            expect((again / name).read_bytes() == (self.out / name).read_bytes(), name + " differs in the replay")


class Bench:
    def __init__(self, swiftletd, swiftlet, folder):
        self.swiftletd, self.swiftlet, self.folder = swiftletd, swiftlet, Path(folder)

    def vehicle(self, *options, port=0):
        return Simulation(self.swiftlet, "--world", "loop", *options, port=port)

    def flight(self, port, *options, **lcm):
        return Flight(self, port, *options, **lcm)


def run_case(cases, case, swiftletd, swiftlet):
    """Calls the function of that name with a Bench of the two programs. Returns the exit code."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            cases[case](Bench(swiftletd, swiftlet, folder))
        except Failed as failure:
            print(failure)
            return 1
    return 0

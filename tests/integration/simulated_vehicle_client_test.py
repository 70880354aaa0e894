#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Talks to `swiftlet sim` over UDP as strictly as the vendor's client does: every request is sent once, in that
client's order, and a reply that is late or has one byte too many or too few is a failure.

simulated_vehicle_client_test.py CASE SWIFTLET. CASE is the name of one of the functions below.
"""

import signal
import socket
import struct
import subprocess
import sys
import time

from simulation import Failed, Simulation, expect

PATIENCE_S = 2.0  # a real client would wait for ever
PARAM, MEMORY, LOG, COMMANDER_GENERIC, SUPERVISOR, PLATFORM, LINK = 2, 4, 5, 7, 9, 13, 15
LOG_TYPES = {1: "<B", 2: "<H", 3: "<L", 4: "<b", 5: "<h", 6: "<i", 7: "<f"}
PARAM_TYPES = {0: "<b", 1: "<h", 2: "<i", 3: "<q", 6: "<f", 7: "<d", 8: "<B", 9: "<H", 10: "<L", 11: "<Q"}
ENOENT = 2


class Client:
    def __init__(self, port):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.connect(("127.0.0.1", port))
        self.log, self.log_types, self.params, self.values = {}, {}, {}, {}
        self.unasked = []  # packets that came between the replies: (port, channel, data)

    def send(self, port, channel, data):
        self.socket.send(bytes([port << 4 | 0x0C | channel]) + bytes(data))

    def receive(self, seconds=PATIENCE_S):
        """(port, channel, data), or None."""
        self.socket.settimeout(seconds)
        try:
            packet = self.socket.recv(1024)
        except socket.timeout:
            return None
        expect(1 <= len(packet) <= 31, f"a datagram of {len(packet)} bytes")
        return packet[0] >> 4, packet[0] & 3, packet[1:]

    def ask(self, port, channel, data, echoed=None):
        """The data of the reply, which begins with the first `echoed` bytes of the request."""
        self.send(port, channel, data)
        return self.take(port, channel, bytes(data)[:len(data) if echoed is None else echoed])

    def take(self, port, channel, pattern):
        """The data of the next packet of that kind that begins with the pattern."""
        until = time.monotonic() + PATIENCE_S
        while time.monotonic() < until:
            packet = self.receive()
            if packet is None:
                break
            if packet[:2] == (port, channel) and packet[2].startswith(pattern):
                return packet[2]
            self.unasked.append(packet)
        raise Failed(f"no reply on {port}:{channel} to {pattern.hex()}")

    def connect(self):
        source = self.ask(LINK, 1, [0], echoed=0)
        expect(source[:18].decode() == "Bitcraze Crazyflie", f"link source {source!r}")
        version = self.ask(PLATFORM, 1, [0])
        expect(version[1] == 12, f"protocol {version[1]}")
        self.fetch_log_table()
        self.fetch_memories()
        self.fetch_param_table()
        self.read_params()
        return self

    def fetch_log_table(self):
        reply = self.ask(LOG, 1, [5])
        expect(len(reply) == 3 and reply[2] == 0, f"log reset: {reply.hex()}")
        info = self.ask(LOG, 0, [3])
        expect(len(info) == 9, f"log table info: {info.hex()}")
        count, self.log_crc, blocks, variables = struct.unpack("<HIBB", info[1:])
        expect((blocks, variables) == (16, 128), "limits of the log service")
        for ident in range(count):
            item = self.ask(LOG, 0, struct.pack("<BH", 2, ident))[3:]
            name = self.name_in(item)
            expect(item[0] in LOG_TYPES, f"{name}: log type {item[0]}")
            expect(name not in self.log, f"{name} is there twice")
            self.log[name], self.log_types[name] = ident, item[0]

    def fetch_memories(self):
        reply = self.ask(MEMORY, 0, [1])
        expect(len(reply) == 2, f"number of memories: {reply.hex()}")
        for ident in range(reply[1]):
            details = self.ask(MEMORY, 0, [2, ident])
            expect(len(details) == 15, f"memory {ident}: {details.hex()}")

    def fetch_param_table(self):
        info = self.ask(PARAM, 0, [3])
        expect(len(info) == 7, f"parameter table info: {info.hex()}")
        count, self.param_crc = struct.unpack("<HI", info[1:])
        extended = []
        for ident in range(count):
            item = self.ask(PARAM, 0, struct.pack("<BH", 2, ident))[3:]
            name = self.name_in(item)
            expect(item[0] & 0x0F in PARAM_TYPES and item[0] & 0x80 == 0, f"{name}: parameter type {item[0]:#x}")
            expect(name not in self.params, f"{name} is there twice")
            self.params[name] = ident, item[0]
            if item[0] & 0x10:
                extended.append(ident)
        expect(extended, "no parameter is persistent")
        for ident in extended:
            reply = self.ask(PARAM, 3, struct.pack("<BH", 7, ident))
            expect(reply[3:] == b"\x00\x01", f"extended type of parameter {ident}: {reply.hex()}")

    @staticmethod
    def name_in(item):
        strings = item[1:].decode("ISO-8859-1").split("\0")
        expect(len(strings) == 3 and strings[2] == "" and strings[0] and strings[1], f"names in {item!r}")
        expect(len(strings[0]) + len(strings[1]) <= 24, f"{strings[:2]} is too long")
        return strings[0] + "." + strings[1]

    def read_params(self):
        for name, (ident, kind) in self.params.items():
            reply = self.ask(PARAM, 1, struct.pack("<H", ident))
            expect(reply[2] == 0, f"{name}: status {reply[2]}")
            self.values[name] = struct.unpack(PARAM_TYPES[kind & 0x0F], reply[3:])[0]

    def write_param(self, name, value):
        ident, kind = self.params[name]
        data = struct.pack("<H", ident) + struct.pack(PARAM_TYPES[kind & 0x0F], value)
        expect(self.ask(PARAM, 2, data, echoed=2) == data, f"{name}: the write is not echoed")

    def start_block(self, block, names, period_ms=100):
        """What does not fit into the first request is appended without waiting for the first reply."""
        entries = [struct.pack("<BH", self.log_types[name], self.log[name]) for name in names]
        create, append = b"".join(entries[:9]), b"".join(entries[9:])
        self.send(LOG, 1, bytes([6, block]) + create)
        if append:
            self.send(LOG, 1, bytes([7, block]) + append)
        for command in [6, 7] if append else [6]:
            reply = self.take(LOG, 1, bytes([command, block]))
            expect(reply == bytes([command, block, 0]), f"block not made: {reply.hex()}")
        expect(self.ask(LOG, 1, [3, block, period_ms // 10], echoed=2) == bytes([3, block, 0]), "block not started")

    def samples(self, block, names, seconds):
        """[(vehicle's milliseconds, values)], while pinging as the client does."""
        layout = "<" + "".join(LOG_TYPES[self.log_types[name]][1] for name in names)
        collected, until, next_ping = [], time.monotonic() + seconds, 0.0
        while time.monotonic() < until:
            if time.monotonic() >= next_ping:
                self.send(LINK, 0, struct.pack("<Bd", 0, time.time()))
                next_ping = time.monotonic() + 0.1
            packet = self.receive(0.02)
            if packet is None:
                continue
            port, channel, data = packet
            if (port, channel) == (LINK, 0):
                struct.unpack("<Bd", data)
            elif (port, channel) == (LOG, 2) and data[0] == block:
                stamp = data[1] | data[2] << 8 | data[3] << 16
                collected.append((stamp, struct.unpack(layout, data[4:])))
            else:
                self.unasked.append(packet)
        return collected

    def console(self):
        return b"".join(data for port, channel, data in self.unasked if (port, channel) == (0, 0)).decode("utf-8")


def scan_finds_the_vehicle(swiftlet):
    simulation = Simulation(swiftlet)
    scanner = Client(simulation.port)
    scanner.socket.send(b"\xff")
    expect(scanner.receive(0.1) == (15, 3, b""), "the scan is not answered with a null packet within 100 ms")
    expect(simulation.end() == 0, "exit code")


def connects_with_full_tables_and_every_parameter(swiftlet):
    simulation = Simulation(swiftlet)
    client = Client(simulation.port).connect()
    expect(len(client.log) >= 390 and len(client.params) >= 240, f"{len(client.log)}, {len(client.params)} entries")
    for name in ["stateEstimate.x", "stateEstimate.yaw", "range.front", "range.zrange", "supervisor.info",
                 "pm.vbatMV", "kalman.varPX", "motion.squal"]:
        expect(name in client.log, f"{name} is not logged")
    expect(client.values["deck.bcMultiranger"] == 1 and client.params["deck.bcMultiranger"][1] == 0x68, "Multiranger")
    expect(client.values["deck.bcFlow2"] == 1, "Flow deck")
    expect(client.values["stabilizer.estimator"] == 2, "the Flow deck makes it use the Kalman filter")
    expect(client.params["kalman.initialYaw"][1] == 0x26, "type of kalman.initialYaw")
    expect(client.ask(LINK, 0, struct.pack("<Bd", 0, 1.5)) == struct.pack("<Bd", 0, 1.5), "ping")
    bits = client.ask(SUPERVISOR, 0, [0x0C], echoed=0)
    expect(bits == bytes([0x8C, 0x0F, 0x00]), f"supervisor: {bits.hex()}")
    simulation.wait_for("client 127.0.0.1:")
    simulation.end()


def a_missing_deck_is_missing(swiftlet):
    simulation = Simulation(swiftlet, "--missing-deck", "multiranger", "--missing-deck", "flow")
    client = Client(simulation.port).connect()
    expect(client.values["deck.bcMultiranger"] == 0 and client.values["deck.bcFlow2"] == 0, "decks")
    names = ["range.front", "range.up", "range.zrange", "stateEstimate.x", "stateEstimate.y"]
    client.start_block(1, names)
    shown = {values for _, values in client.samples(1, names, 4.0)}
    expect(shown == {(0, 0, 0, 0.0, 0.0)}, f"shown without decks: {shown}")
    simulation.end()


def a_log_block_comes_at_10_hz(swiftlet):
    simulation = Simulation(swiftlet, "--clock-start", "16775.5")  # the 24-bit clock wraps at 16777.216 s
    client = Client(simulation.port).connect()
    names = ["stateEstimate.x", "stateEstimate.y", "stateEstimate.yaw", "range.front", "range.back", "range.left",
             "range.right", "range.zrange", "supervisor.info", "pm.vbatMV"]
    client.start_block(7, names)
    samples = client.samples(7, names, 5.0)
    simulation.wait_for("took off")
    expect(46 <= len(samples) <= 51, f"{len(samples)} samples in 5 s")
    stamps = [stamp for stamp, _ in samples]
    steps = [(b - a) & 0xFFFFFF for a, b in zip(stamps, stamps[1:])]
    expect(all(97 <= step <= 103 for step in steps), f"steps {steps}")
    expect(min(stamps) < 6000 and max(stamps) > 16_700_000, "the clock does not wrap")
    expect(samples[-1][1][8] & 0x10, "it does not fly")
    expect(3400 < samples[-1][1][9] < 4300, "battery")
    expect(client.ask(LOG, 1, [4, 7], echoed=2) == bytes([4, 7, 0]), "stop")
    expect(client.ask(LOG, 1, [2, 7], echoed=2) == bytes([2, 7, 0]), "delete")
    expect(client.ask(LOG, 1, [2, 7], echoed=2) == bytes([2, 7, ENOENT]), "delete again")
    simulation.end()


def the_console_tells_of_the_boot(swiftlet):
    simulation = Simulation(swiftlet)
    client = Client(simulation.port).connect()
    lines = client.console().splitlines()
    expect(any("2 deck(s) found" in line for line in lines), f"console: {lines}")
    simulation.end()


def a_written_parameter_is_obeyed(swiftlet):
    simulation = Simulation(swiftlet)
    client = Client(simulation.port).connect()
    names = ["stateEstimate.x"]
    client.start_block(1, names)
    client.write_param("kalman.initialX", 2.5)
    client.write_param("kalman.resetEstimation", 1)
    samples = client.samples(1, names, 0.6)
    expect(abs(samples[-1][1][0] - 2.5) < 0.2, f"estimate {samples[-1]}")
    ident = client.params["kalman.resetEstimation"][0]
    expect((PARAM, 3, struct.pack("<BHB", 1, ident, 0)) in client.unasked, "not told that the reset is done")
    read_only, _ = client.params["deck.bcFlow2"]
    client.send(PARAM, 2, struct.pack("<HB", read_only, 0))
    after = client.ask(PARAM, 1, struct.pack("<H", read_only))
    expect(after[3] == 1, "a read-only parameter was written")
    expect(not [p for p in client.unasked if p[:2] == (PARAM, 2)], "a write to a read-only parameter was answered")
    simulation.end()


def a_reboot_forgets_blocks_and_time(swiftlet):
    simulation = Simulation(swiftlet, "--clock-start", "1000")
    client = Client(simulation.port).connect()
    names = ["stateEstimate.x"]
    client.start_block(1, names)
    expect(client.samples(1, names, 1.0)[-1][0] > 1_000_000, "the clock's start")
    began = time.monotonic()
    simulation.instruct("reboot")
    simulation.wait_for("vehicle silent")
    while client.receive(0.05):
        pass  # what was under way
    client.socket.send(b"\xff")
    expect(client.receive(0.5) is None, "answers while it boots")
    simulation.wait_for("vehicle on air")
    expect(1.5 < time.monotonic() - began < 4.5, f"booted in {time.monotonic() - began} s")
    expect(client.ask(LOG, 1, [3, 1, 10], echoed=2) == bytes([3, 1, ENOENT]), "the block outlived the reboot")
    info = client.ask(LOG, 0, [3])
    expect(struct.unpack("<I", info[3:7])[0] == client.log_crc, "another table after the reboot")
    client.start_block(1, names)
    expect(client.samples(1, names, 0.5)[0][0] < 6000, "the clock did not begin anew")
    simulation.end()


def another_client_may_take_over(swiftlet):
    simulation = Simulation(swiftlet)
    first = Client(simulation.port).connect()
    first.start_block(1, ["stateEstimate.x"])
    first.socket.close()
    simulation.wait_for("client ")
    simulation.wait_for("client ")  # gone, after a second of silence
    second = Client(simulation.port)
    expect(second.ask(LOG, 1, [3, 1, 10], echoed=2) == bytes([3, 1, ENOENT]), "the watchdog kept the block")
    second.connect()
    names = ["range.left"]
    second.start_block(2, names)
    expect(len(second.samples(2, names, 1.0)) >= 8, "no data for the second client")
    simulation.end()


def ends_cleanly_when_told(swiftlet):
    simulation = Simulation(swiftlet)
    simulation.process.stdin.write("loss 200\nquit\n")
    simulation.process.stdin.flush()
    simulation.wait_for("loss takes 0 to 100 percent")
    expect(simulation.process.wait(timeout=PATIENCE_S) == 0, "exit code after quit")
    for number in [signal.SIGINT, signal.SIGTERM]:
        simulation = Simulation(swiftlet)
        simulation.process.stdin.close()  # the end of stdin is not its end
        Client(simulation.port).ask(LINK, 0, [1])
        simulation.process.send_signal(number)
        expect(simulation.process.wait(timeout=PATIENCE_S) == 0, f"exit code after signal {number}")


def a_port_in_use_is_refused(swiftlet):
    simulation = Simulation(swiftlet)
    second = subprocess.run([swiftlet, "sim", "--udp", f"127.0.0.1:{simulation.port}"], capture_output=True,
                            text=True, timeout=PATIENCE_S, check=False)
    expect(second.returncode == 2 and second.stderr.count("\n") == 1, f"{second.returncode} {second.stderr!r}")
    expect(str(simulation.port) in second.stderr and second.stdout == "", f"{second.stderr!r}")
    simulation.end()


def main(case, swiftlet):
    try:
        globals()[case](swiftlet)
    except Failed as why:
        print(f"{case}: {why}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

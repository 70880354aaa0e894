# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""`swiftlet sim` as a process under a test's control."""

import select
import socket
import subprocess
import threading

PATIENCE_S = 20.0


class Failed(Exception):
    """A program did something else than it should."""


def expect(condition, why):
    if not condition:
        raise Failed(why)


class Simulation:
    """`swiftlet sim` on a port of the loopback; 0: any that is free."""

    def __init__(self, swiftlet, *options, port=0):
        self.process = subprocess.Popen([swiftlet, "sim", "--udp", f"127.0.0.1:{port}", *options],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        text=True)
        first = self.process.stdout.readline()
        expect(first.startswith("listening on udp://127.0.0.1:"), f"no port announced: {first!r}")
        self.port = int(first.split(",")[0].rsplit(":", 1)[1])

    def type(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def instruct(self, line):
        """Types a line; comes back when it is done."""
        self.type(line)
        self.wait_for("done: " + line)

    def wait_for(self, notice):
        for line in self.process.stdout:
            if line.startswith(notice):
                return line.strip()
        raise Failed(f"ended before it said {notice!r}")

    def end(self):
        if self.process.poll() is None:
            self.process.terminate()
        self.process.communicate(timeout=PATIENCE_S)
        return self.process.returncode


class RegisteringDoor:
    """A simulator as CrazySim opens it: who says `f3` first has the vehicle at `vehicle_port` until it says `f4`; all
    others are ignored."""

    def __init__(self, vehicle_port):
        self.outer = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.outer.bind(("127.0.0.1", 0))
        self.port = self.outer.getsockname()[1]
        self.inner = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.inner.connect(("127.0.0.1", vehicle_port))
        self.client = None
        self.is_open = True
        self.thread = threading.Thread(target=self.serve)
        self.thread.start()

    def serve(self):
        while self.is_open:
            ready, _, _ = select.select([self.outer, self.inner], [], [], 0.1)
            if self.outer in ready:
                self.on_client(*self.outer.recvfrom(64))
            if self.inner in ready and self.client:
                self.outer.sendto(self.inner.recv(64), self.client)
            elif self.inner in ready:
                self.inner.recv(64)

    def on_client(self, packet, sender):
        if packet == b"\xf3" and self.client is None:
            self.client = sender
        if sender != self.client:
            return
        if packet == b"\xf4":
            self.client = None
        else:
            self.inner.send(packet)

    def close(self):
        self.is_open = False
        self.thread.join()
        self.outer.close()
        self.inner.close()

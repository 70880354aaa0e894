# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""`swiftlet sim` as a process under a test's control."""

import subprocess

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

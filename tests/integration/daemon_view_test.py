#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""swiftletd --view as its users run it: the page is fetched and its messages are read from the daemon itself, while the
daemon flies through a simulated building.

daemon_view_test.py CASE SWIFTLETD. CASE is the name of one of the functions below.
"""

import http.client
import json
import re
import socket
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

PATIENCE_S = 60
FLIGHT = "sim://loop?seed=1"
POSES, TILES = 1, 3
HEADER_BYTES, POSE_BYTES, TILE_BYTES = 16, 88, 12 + 64 * 64


def expect(condition, why):
    if not condition:
        print(why)
        sys.exit(1)


class Daemon:
    """swiftletd with a page, publishing nowhere else."""

    def __init__(self, swiftletd, *options):
        command = [swiftletd, FLIGHT, "--view", "127.0.0.1:0", "--lcm-url", "memq://", *map(str, options)]
        self.process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        self.said = []
        while not (found := re.search(r"http://127\.0\.0\.1:(\d+)", self.line())):
            pass
        self.port = int(found[1])

    def line(self):
        line = self.process.stderr.readline()
        expect(line, "swiftletd named no address:\n" + "".join(self.said))
        self.said.append(line)
        return line

    def wait(self):
        self.said += self.process.communicate(timeout=PATIENCE_S)[1].splitlines(keepends=True)
        return self.process.returncode

    def get(self, path, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE_S)
        connection.request("GET", path, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read()


class Page:
    """What a page receives: the messages of /live."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE_S)
        self.socket.sendall(b"GET /live HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                            b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n" % port)
        self.stream = self.socket.makefile("rb")
        expect(b" 101 " in self.stream.readline(), "no WebSocket")
        while self.stream.readline().strip():
            pass

    def messages(self):
        """Until the connection ends: JSON as objects, the rest as bytes."""
        content, is_text = b"", False
        while len(head := self.stream.read(2)) == 2:
            opcode, size = head[0] & 15, head[1]
            if size == 126:
                size, = struct.unpack(">H", self.stream.read(2))
            elif size == 127:
                size, = struct.unpack(">Q", self.stream.read(8))
            part = self.stream.read(size)
            if opcode == 8 or len(part) < size:
                return
            content, is_text = (part, opcode == 1) if opcode in (1, 2) else (content + part, is_text)
            if head[0] & 128:
                yield json.loads(content) if is_text else content


class SeenRun:
    """What a page that reads everything knows in the end."""

    def __init__(self, port):
        self.status, self.poses_with_hits, self.versions = {}, 0, {}
        try:
            for message in Page(port).messages():
                self.take(message)
        except ConnectionResetError:
            pass  # the daemon has ended

    def take(self, message):
        if isinstance(message, dict):
            self.status = message if message["type"] == "status" else self.status
            return
        kind, count, value = struct.unpack_from("<IId", message)
        if kind == POSES:
            self.take_poses(message, count, beams=int(value))
        for i in range(count if kind == TILES else 0):
            x, y, version = struct.unpack_from("<iiI", message, HEADER_BYTES + i * TILE_BYTES)
            self.versions[x, y] = version

    def take_poses(self, message, count, beams):
        first, record_bytes = HEADER_BYTES + 4 * beams, POSE_BYTES + 4 * beams
        expect(len(message) == first + count * record_bytes, f"{count} poses in {len(message)} bytes")
        for record in range(first, len(message), record_bytes):
            self.poses_with_hits += max(struct.unpack_from(f"<{beams}f", message, record + POSE_BYTES), default=0) > 0


def the_daemon_serves_the_page_and_the_whole_run(swiftletd, _folder):
    daemon = Daemon(swiftletd, "--rate", 100, "--no-output")
    status, page = daemon.get("/")
    expect(status == 200 and b"<title>swiftlet</title>" in page, f"the page: {status}")
    expect(daemon.get("/", Origin="http://evil.example")[0] == 403, "a foreign page was answered")
    seen = SeenRun(daemon.port)
    expect(daemon.wait() == 0, "".join(daemon.said))
    expect(seen.status.get("state") == 2, f"the page was not told of the end: {seen.status}")
    samples = seen.status["samples"]
    expect(seen.poses_with_hits > 0.9 * samples, f"{seen.poses_with_hits} of {samples} poses came with beams that hit")
    map_of_page = len(seen.versions), sum(seen.versions.values())
    expect(map_of_page == (seen.status["tile_count"], seen.status["version_sum"]), f"the map is not complete: {map_of_page}")
    expect(sum("http://" in line for line in daemon.said) == 1, "not one line names the page")


def a_page_that_reads_nothing_changes_nothing(swiftletd, folder):
    subprocess.run([swiftletd, FLIGHT, "--rate", "1000", "--lcm-url", "memq://", "-o", folder / "alone"], check=True,
                   capture_output=True, timeout=PATIENCE_S)
    daemon = Daemon(swiftletd, "--rate", 1000, "-o", folder / "seen")
    pages = [Page(daemon.port) for _ in range(10)]
    expect(daemon.wait() == 0, "".join(daemon.said))
    del pages
    for name in ("trajectory.tum", "map.pgm"):
        expect((folder / "alone" / name).read_bytes() == (folder / "seen" / name).read_bytes(), name + " differs")


def what_cannot_be_served_gets_one_line_and_exit_code_2(swiftletd, folder):
    configuration = folder / "settings.toml"
    configuration.write_text('[view]\naddress = "nowhere"\n')
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        for options in ([FLIGHT, "--view", f"127.0.0.1:{taken.getsockname()[1]}"], [FLIGHT, "--view", "somewhere:80"],
                        [FLIGHT, "--view", "127.0.0.1:x"], ["--view", FLIGHT], [FLIGHT, "--config", configuration]):
            done = subprocess.run([swiftletd, *options, "--no-output", "--lcm-url", "memq://"], capture_output=True,
                                  text=True, timeout=PATIENCE_S, check=False)
            is_told = len(done.stderr.splitlines()) == 1 and re.search(r"--view|view\.address", done.stderr)
            expect(done.returncode == 2 and is_told, f"{options}: {done}")


def main():
    case, swiftletd = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        globals()[case](swiftletd, Path(folder))


if __name__ == "__main__":
    main()

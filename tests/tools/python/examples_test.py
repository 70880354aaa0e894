#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Runs the examples of docs/python.md, one after the other in one program, in a network of their own: those that listen
beside a swiftletd. examples_test.py SWIFTLET SWIFTLETD"""

import importlib.util
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
SWIFTLET, SWIFTLETD = sys.argv[1:3]
INSIDE = "--in-own-network"
NETWORK = ["unshare", "--user", "--map-root-user", "--net", "--", "sh", "-c",
           'ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo && exec "$@"', "sh"]
PAGE = ROOT / "docs" / "python.md"


def run_examples():
    names = {"__name__": "__main__"}
    text = PAGE.read_text(encoding="utf-8")
    examples = list(re.finditer(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE))
    assert len(examples) > 7, "examples are missing"
    for example in examples:
        if "import matplotlib" in example[1] and importlib.util.find_spec("matplotlib") is None:
            print("skipped: python3-matplotlib is not installed")
            continue
        line = text.count("\n", 0, example.start(1))
        code = compile("\n" * line + example[1], PAGE.name, "exec")
        daemon = None
        if "listen" in example[1]:
            daemon = subprocess.Popen([SWIFTLETD, "sim://patrol", "--rate", "20", "--no-output"],
                                      stderr=subprocess.DEVNULL)
        try:
            exec(code, names)  # pylint: disable=exec-used
        finally:
            if daemon is not None:
                daemon.kill()
                daemon.wait()
    return names


def main():
    if INSIDE not in sys.argv:
        environment = {name: value for name, value in os.environ.items() if name != "LCM_DEFAULT_URL"}
        return subprocess.run([*NETWORK, sys.executable, __file__, SWIFTLET, SWIFTLETD, INSIDE], check=False,
                              env=environment).returncode
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        subprocess.run([SWIFTLET, "record", "sim://patrol", "-o", "flight.pcap"], check=True, stdout=subprocess.DEVNULL)
        names = run_examples()
        assert names["message"].state == "finished" and names["tiles"].is_complete(names["message"]), names["message"]
        assert names["pose"] is not None and names["pose"].frame == "local", names["pose"]
        assert {"hit_x_m", "hit_y_m"} <= names.keys(), "no beam of a pose was received"
        os.chdir("/")
    return 0


if __name__ == "__main__":
    sys.exit(main())

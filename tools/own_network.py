# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""A network namespace for a tool whose programs publish over LCM: nothing else is received, nothing leaves the
machine."""

import os
import subprocess
import sys

INSIDE = "--in-own-network"  # an argument of every tool that uses this
LOOPBACK = ["sh", "-c", 'ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo && exec "$@"', "sh"]


def run_again(script):
    """Runs `script` with the same arguments and INSIDE in a network namespace, and returns its exit code. Root stays
    root, for its priorities."""
    unshare = ["unshare", "--net"] + ([] if os.geteuid() == 0 else ["--user", "--map-root-user"])
    return subprocess.run([*unshare, "--", *LOOPBACK, sys.executable, script, INSIDE, *sys.argv[1:]],
                          check=False).returncode

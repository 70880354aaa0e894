# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""A program of Python that Ctrl-C is to end."""

import signal
import subprocess
import sys


def exit_code_after_ctrl_c(script):
    """Of a program that gets SIGINT once it has printed "begun"."""
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True) as program:
        try:
            assert program.stdout.readline() == "begun\n"
            program.send_signal(signal.SIGINT)
            program.communicate(timeout=60)
        finally:
            program.kill()
    return program.returncode

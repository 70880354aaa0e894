# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""map.pgm, as swiftlet writes it."""

import numpy as np

FREE, UNKNOWN, OCCUPIED = 254, 205, 0


def pixels_of(path):
    kind, size, highest, pixels = path.read_bytes().split(b"\n", 3)
    assert (kind, highest) == (b"P5", b"255")
    columns, rows = (int(number) for number in size.split())
    return np.frombuffer(pixels, np.uint8).reshape(rows, columns)

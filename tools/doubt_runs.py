# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The flights that `tools/plot-doubt` draws: what was published of them beside the truth."""

import bisect
import dataclasses
import json
from pathlib import Path

import benchmark_page as page
import log_sharpness
import whole_runs

SIGMAS_95 = 2.448  # of a normal distribution in the plane, equal in both directions: 95 % lie within
OCCUPIED = 0  # of a pixel of map.pgm


@dataclasses.dataclass(frozen=True)
class Flight:
    """A flight as published, put onto the truth by the poses before its fault. Positions are complex numbers, m."""
    time_s: list  # after the first sample, as all that follows one for each sample
    live: list
    true: list
    radius_95_m: list
    state: list
    walls: list  # middles of the occupied cells of the final map

    def errors_m(self):
        return [abs(a - b) for a, b in zip(self.live, self.true)]

    def index_at(self, time_s):
        """The first sample at that time or later."""
        return bisect.bisect_left(self.time_s, time_s)

    def found_back(self):
        """The sample with which the published pose jumps back: the greatest fall of its error."""
        errors = self.errors_m()
        return max(range(1, len(errors)), key=lambda i: errors[i - 1] - errors[i])

    def stretches(self):
        """(state, index of its first sample, one behind its last), in order of time."""
        first = 0
        for i in range(1, len(self.state) + 1):
            if i == len(self.state) or self.state[i] != self.state[first]:
                yield self.state[first], first, i
                first = i


def onto(pairs):
    """The rigid motion of the plane that puts the first positions of the pairs onto the second, by least squares.
    Positions are complex numbers, m."""
    centre_from = sum(a for a, _ in pairs) / len(pairs)
    centre_to = sum(b for _, b in pairs) / len(pairs)
    turn = sum((a - centre_from).conjugate() * (b - centre_to) for a, b in pairs)
    turn /= abs(turn)
    return lambda position: centre_to + turn * (position - centre_from)


def walls_of(folder):
    """Middles of the occupied cells of map.pgm, as complex numbers in frame map."""
    yaml = dict(line.split(": ", 1) for line in Path(folder, "map.yaml").read_text(encoding="utf-8").splitlines())
    x_m, y_m = (float(part) for part in yaml["origin"].strip("[]").split(",")[:2])
    cell_m = float(yaml["resolution"])
    _, size, _, pixels = Path(folder, "map.pgm").read_bytes().split(b"\n", 3)
    columns, rows = map(int, size.split())
    return [complex(x_m + (i % columns + 0.5) * cell_m, y_m + (rows - i // columns - 0.5) * cell_m)
            for i, pixel in enumerate(pixels) if pixel == OCCUPIED]


def flight(swiftlet, source, fault_s, folder):
    """Maps the source. Raises OSError or subprocess.CalledProcessError."""
    whole_runs.run(swiftlet, [source], folder)
    rows = json.loads(page.run(str(swiftlet), "eval", "--live", source, "--json", "-"))["poses"]
    truth = {stamp: complex(*pose[:2])
             for stamp, pose in log_sharpness.poses_of(Path(folder, "ground_truth.tum")).items()}
    rows = [row for row in rows if round(row[0] * 1e3) in truth]
    true = [truth[round(row[0] * 1e3)] for row in rows]
    start = min(truth) * 1e-3
    live = [complex(row[1], row[2]) for row in rows]
    placed = onto([(a, b) for a, b, row in zip(live, true, rows) if row[0] < start + fault_s])
    return Flight([row[0] - start for row in rows], [placed(a) for a in live], true,
                  [SIGMAS_95 * row[4] for row in rows], [row[6] for row in rows],
                  [placed(wall) for wall in walls_of(folder)])

# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Estimates the scale of an odometry, and the yaw that it misses per metre, from relations: motions that were measured
by other means."""

import bisect
import itertools
import math
from pathlib import Path

LONGEST_S = 20.0  # over longer spans other errors of the odometry exceed the systematic ones
SAME_STAMP_S = 0.002
SHORTEST_M = 0.1  # a shorter motion has no direction


def rows(path):
    lines = Path(path).read_text(encoding="utf-8").splitlines()
    return [[float(word) for word in line.split()] for line in lines if line.strip() and not line.startswith("#")]


def wrapped(angle_rad):
    return math.remainder(angle_rad, 2.0 * math.pi)


def between(start, end):
    """The pose (x, y, yaw) `end` as seen from `start`."""
    x, y = end[0] - start[0], end[1] - start[1]
    c, s = math.cos(start[2]), math.sin(start[2])
    return c * x + s * y, c * y - s * x, wrapped(end[2] - start[2])


class Odometry:
    """Poses of a TUM file, and the metres forward up to each."""

    def __init__(self, path):
        lines = rows(path)
        self.stamps_s = [line[0] for line in lines]
        self.poses = [(line[1], line[2], 2.0 * math.atan2(line[6], line[7])) for line in lines]
        steps_m = (between(start, end)[0] for start, end in itertools.pairwise(self.poses))
        self.forward_m = list(itertools.accumulate(steps_m, initial=0.0))

    def find(self, stamp_s):
        """Index of the pose at that time; None where there is none."""
        first = bisect.bisect_left(self.stamps_s, stamp_s - SAME_STAMP_S)
        there = first < len(self.stamps_s) and self.stamps_s[first] <= stamp_s + SAME_STAMP_S
        return first if there else None


def pairs(relations, odometry):
    """True motion, measured motion and metres forward of each relation that spans a short time and has its poses."""
    for t1_s, t2_s, x_m, y_m, _, _, _, yaw_rad in relations:
        i, j = odometry.find(t1_s), odometry.find(t2_s)
        if i is not None and j is not None and abs(t2_s - t1_s) < LONGEST_S:
            yield ((x_m, y_m, yaw_rad), between(odometry.poses[i], odometry.poses[j]),
                   odometry.forward_m[j] - odometry.forward_m[i])


def scale_of(used):
    """Metres moved along the measured motion for each metre measured, and the standard deviation. A ratio of sums,
    because single motions are hardly longer than the relations' own noise."""
    along = [((true[0] * measured[0] + true[1] * measured[1]) / measured_m, measured_m)
             for true, measured, _ in used if (measured_m := math.hypot(*measured[:2])) > SHORTEST_M]
    if not along:
        return None
    total_m = sum(measured_m for _, measured_m in along)
    scale = sum(moved_m for moved_m, _ in along) / total_m
    return scale, math.sqrt(sum((moved_m - scale * measured_m)**2 for moved_m, measured_m in along)) / total_m


def missed_yaw_of(used):
    """Yaw missed per metre forward, without the share of each turn, and the standard deviation, in rad/m."""
    rows_of = [(forward, measured[2], wrapped(true[2] - measured[2])) for true, measured, forward in used]
    turned = sum(turn**2 for _, turn, _ in rows_of)
    if turned == 0.0:
        return None
    forward_of_turn = sum(forward * turn for forward, turn, _ in rows_of) / turned
    missed_of_turn = sum(missed * turn for _, turn, missed in rows_of) / turned
    apart = [(forward - forward_of_turn * turn, missed - missed_of_turn * turn) for forward, turn, missed in rows_of]
    squares = sum(forward**2 for forward, _ in apart)
    if squares == 0.0:
        return None
    slope = sum(forward * missed for forward, missed in apart) / squares
    scatter = sum((forward * (missed - slope * forward))**2 for forward, missed in apart)
    return slope, math.sqrt(scatter) / squares


def estimate(relations_file, odometry_file):
    """`relations`: the number used; `scale` and `missed_yaw_per_metre_rad`, each with its standard deviation, None
    where there are too few. Raises OSError or ValueError."""
    used = list(pairs(rows(relations_file), Odometry(odometry_file)))
    return {"relations": len(used), "scale": scale_of(used), "missed_yaw_per_metre_rad": missed_yaw_of(used)}

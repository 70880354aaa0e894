# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""What relations, motions that were measured by other means, say of an odometry: its scale, and the yaw that it misses
with each metre."""

import bisect
import itertools
import math
from pathlib import Path

LONGEST_S = 20.0  # what lies farther apart is joined by more of the odometry than its steady errors
SAME_STAMP_S = 0.002
SHORTEST_M = 0.2  # of less the noise says more than the scale


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
    """Poses of a TUM file, and the metres forward on the way to each."""

    def __init__(self, path):
        lines = rows(path)
        self.stamps_s = [line[0] for line in lines]
        self.poses = [(line[1], line[2], 2.0 * math.atan2(line[6], line[7])) for line in lines]
        steps_m = (between(start, end)[0] for start, end in itertools.pairwise(self.poses))
        self.forward_m = list(itertools.accumulate(steps_m, initial=0.0))

    def find(self, stamp_s):
        """Index of the pose of that time; None where there is none."""
        first = bisect.bisect_left(self.stamps_s, stamp_s - SAME_STAMP_S)
        there = first < len(self.stamps_s) and self.stamps_s[first] <= stamp_s + SAME_STAMP_S
        return first if there else None


def pairs(relations, odometry):
    """True motion, measured motion and metres forward of each relation that is short in time and has its poses."""
    for t1_s, t2_s, x_m, y_m, _, _, _, yaw_rad in relations:
        i, j = odometry.find(t1_s), odometry.find(t2_s)
        if i is not None and j is not None and abs(t2_s - t1_s) < LONGEST_S:
            yield ((x_m, y_m, yaw_rad), between(odometry.poses[i], odometry.poses[j]),
                   odometry.forward_m[j] - odometry.forward_m[i])


def estimate(relations_file, odometry_file):
    """`relations`: how many were used; `scale`: metres moved for each measured; `missed_yaw_per_metre_rad`, with a share
    of each turn taken out. None where there are too few. Raises OSError or ValueError."""
    used = list(pairs(rows(relations_file), Odometry(odometry_file)))
    far = [(math.hypot(*true[:2]), math.hypot(*measured[:2])) for true, measured, _ in used
           if math.hypot(*true[:2]) >= SHORTEST_M]
    across = sum(true * measured for true, measured in far)
    mm = sum(forward**2 for _, _, forward in used)
    tt = sum(measured[2]**2 for _, measured, _ in used)
    mt = sum(forward * measured[2] for _, measured, forward in used)
    missed = [wrapped(true[2] - measured[2]) for true, measured, _ in used]
    my = sum(yaw * forward for yaw, (_, _, forward) in zip(missed, used))
    ty = sum(yaw * measured[2] for yaw, (_, measured, _) in zip(missed, used))
    determinant = mm * tt - mt**2
    if across <= 0.0 or determinant <= 0.0:
        return None
    return {"relations": len(used), "scale": sum(true**2 for true, _ in far) / across,
            "missed_yaw_per_metre_rad": (my * tt - ty * mt) / determinant}

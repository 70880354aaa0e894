# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The sharpness of a laser log drawn along a trajectory, without a truth: the number of distinct cells that contain
returns. All readings are drawn, those that were not used for mapping, too."""

import math

import changed_log

CELL_M = 0.1
NEAREST_M, FARTHEST_M = 0.1, 5.0  # of a return
STEP_DEG = {180: 1.0, 181: 1.0, 360: 0.5, 361: 0.5}  # of scanners that see 180 degrees, by readings


def poses_of(trajectory):
    """{stamp in ms: (x_m, y_m, yaw_rad)} of a TUM file."""
    rows = [list(map(float, line.split())) for line in trajectory.read_text(encoding="utf-8").splitlines()
            if line.strip() and not line.startswith("#")]
    return {round(row[0] * 1e3): (row[1], row[2], 2.0 * math.atan2(row[6], row[7])) for row in rows}


def evaluate(trajectory, log):
    """Figures as `swiftlet eval` has them for a flight. Raises as changed_log.read() does, and ValueError for other
    scanners than those of 180 degrees."""
    poses = poses_of(trajectory)
    recording = changed_log.read(log)
    cells, returns, drawn = set(), 0, 0
    for measured_s, ranges in recording.scans:
        pose = poses.get(round((measured_s + recording.scan_delay_s()) * 1e3))
        if pose is None:
            continue
        drawn += 1
        x_m, y_m, yaw = pose
        if len(ranges) not in STEP_DEG:
            raise ValueError(f"{log}: how {len(ranges)} readings lie is not known")
        step = math.radians(STEP_DEG[len(ranges)])
        for i, text in enumerate(ranges):
            distance_m = float(text)
            if NEAREST_M < distance_m < FARTHEST_M:
                angle = yaw - math.pi / 2.0 + i * step
                cells.add((math.floor((x_m + distance_m * math.cos(angle)) / CELL_M),
                           math.floor((y_m + distance_m * math.sin(angle)) / CELL_M)))
                returns += 1
    return {"kind": "laser log", "scans": len(recording.scans), "drawn": drawn, "returns": returns,
            "cells_10_cm": len(cells)}

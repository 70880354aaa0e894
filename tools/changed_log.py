# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Copies of CARMEN logs in which the robot drives the same paths differently, or its wheels have larger errors: what
holds for one log by luck does not hold for all its copies. A trajectory mapped from a copy is transformed back to the
stamps and the direction of the log, and evaluated by its relations."""

import bisect
import dataclasses
import gzip
import math
import random

BEHIND_ODOMETRY_S = 0.1  # scans of a log with ODOM lines are that much older than their stamps
BETWEEN_RANDOM_TURNS_M = 20.0
LINES_AROUND = 10  # are averaged to a regular time
PAUSE_S = 5.0  # is not averaged over
AROUND_SCANS_S = 0.5  # of dead reckoning in lines of its own that stays at a cut
# Standard deviations of noise 1: after 100 m of travel the position is off by about 3 % of the way.
NOISE_XY_M_PER_SQRT_M = 0.01
NOISE_YAW_RAD_PER_SQRT_M = math.radians(0.3)
NOISE_YAW_RAD_PER_SQRT_RAD = math.radians(1.0)


@dataclasses.dataclass(frozen=True)
class Change:
    name: str
    backwards: bool = False  # in time: the robot drives the whole path in reverse
    mirrored: bool = False  # left is right
    turns: float = 1.0  # measured by dead reckoning for each turn of one
    metres: float = 1.0
    drift_deg_per_m: float = 0.0  # forward; with the other sign when going back
    random_turns_deg: float = 0.0  # standard deviation of turns that did not happen
    seed: int = 0
    noise: float = 0.0  # times the random walks of NOISE_*
    lead_s: float = 0.0  # dead reckoning runs ahead of the ranges by so much more than in the log
    first: float = 0.0  # share of the scans at which the copy begins, as it is played
    last: float = 1.0  # ... and ends


@dataclasses.dataclass(frozen=True)
class Recording:
    poses: list  # of dead reckoning: (stamp, (x_m, y_m, yaw_rad))
    scans: list  # (stamp of the measurement, ranges as texts)
    is_odometry_in_scans: bool  # one pose for each scan; else poses have lines of their own

    def scan_delay_s(self):
        """From the measurement of a scan to its stamp."""
        return 0.0 if self.is_odometry_in_scans else BEHIND_ODOMETRY_S

    def ends_s(self):
        """Sum of the first stamp of a scan and the last: t and ends_s() - t are the same moment, the other way."""
        return self.scans[0][0] + self.scans[-1][0]


def read(path, lines_ahead=0):
    """Reads a gzipped log of FLASER lines whose ODOM lines, if any, are complete. Like swiftlet, takes dead reckoning
    from these or, where their stamps go back, from the scans' own, which there precedes the ranges by `lines_ahead`
    lines. Raises OSError or EOFError where the log cannot be read, ValueError where it holds no scan."""
    odometry, in_scans, scans = [], [], []
    with gzip.open(path, "rt", encoding="latin-1") as file:
        for line in file:
            words = line.split()
            if line.startswith("ODOM "):
                odometry.append((float(words[7]), tuple(map(float, words[1:4]))))
            elif line.startswith("FLASER "):
                count = int(words[1])
                scans.append((float(words[-3]), words[2:2 + count]))
                in_scans.append((float(words[-3]), tuple(map(float, words[count + 5:count + 8]))))
    if not scans:
        raise ValueError(f"{path}: holds no scan")
    if odometry and odometry == sorted(odometry, key=lambda pose: pose[0]):
        return Recording(odometry, sorted((stamp - BEHIND_ODOMETRY_S, ranges) for stamp, ranges in scans), False)
    in_scans.sort(key=lambda pose: pose[0])
    ahead = [(stamp, in_scans[max(i - lines_ahead, 0)][1]) for i, (stamp, _) in enumerate(in_scans)]
    return Recording(ahead, sorted(scans, key=lambda scan: scan[0]), True)


def wrapped(angle_rad):
    return math.remainder(angle_rad, math.tau)


def turned_round(recording, change):
    """Backwards and mirrored, as the change has it."""
    def stamp(old):
        return recording.ends_s() - old if change.backwards else old

    order = -1 if change.backwards else 1
    side = -1 if change.mirrored else 1
    return Recording([(stamp(t), (x, side * y, side * yaw)) for t, (x, y, yaw) in recording.poses[::order]],
                     [(stamp(t), ranges[::side]) for t, ranges in recording.scans[::order]],
                     recording.is_odometry_in_scans)


def cut(recording, change):
    """The scans from `first` to `last`, and the poses that belong to them."""
    count = len(recording.scans)
    begin, end = round(change.first * count), round(change.last * count)
    scans = recording.scans[begin:end]
    if not scans:
        raise ValueError(f"{change.name}: leaves no scan")
    if recording.is_odometry_in_scans:
        return Recording(recording.poses[begin:end], scans, True)
    return Recording([pose for pose in recording.poses if begin == 0 or pose[0] >= scans[0][0] - AROUND_SCANS_S
                      if end == count or pose[0] <= scans[-1][0] + AROUND_SCANS_S], scans, False)


def pose_at(stamps, poses, stamp):
    """Interpolated; the first or last one beyond the ends."""
    after = min(max(bisect.bisect_left(stamps, stamp), 1), len(poses) - 1)
    (t0, (x0, y0, yaw0)), (t1, (x1, y1, yaw1)) = poses[after - 1], poses[after]
    share = min(max((stamp - t0) / (t1 - t0), 0.0), 1.0) if t1 > t0 else 0.0
    return x0 + share * (x1 - x0), y0 + share * (y1 - y0), wrapped(yaw0 + share * wrapped(yaw1 - yaw0))


def regular_times(stamps):
    """Scanners measure at regular intervals, but Intel's stamps come in bunches, and a lead in such stamps would be a
    number of lines drawn by chance. The mean of the stamps around, as many on either side; pauses stay."""
    times, first = [], 0
    for end in range(1, len(stamps) + 1):
        if end < len(stamps) and stamps[end] - stamps[end - 1] <= PAUSE_S:
            continue
        for i in range(first, end):
            around = min(LINES_AROUND, i - first, end - 1 - i)
            times.append(sum(stamps[i - around:i + around + 1]) / (2 * around + 1))
        first = end
    return times


def ahead(poses, lead_s, times=None):
    """At each stamp the pose of `lead_s` later. `times`: of the poses, where their stamps are not."""
    if lead_s == 0.0 or len(poses) < 2:
        return poses
    times = times or [stamp for stamp, _ in poses]
    timed = [(time, pose) for time, (_, pose) in zip(times, poses)]
    return [(stamp, pose_at(times, timed, time + lead_s)) for time, (stamp, _) in zip(times, poses)]


def with_errors(poses, change):
    """Dead reckoning over the same steps, with an error in each."""
    chance = random.Random(change.seed)
    (stamp, last), path_m = poses[0], 0.0
    x_m, y_m, yaw_rad = last
    next_turn_m = BETWEEN_RANDOM_TURNS_M
    found = [(stamp, last)]
    for stamp, now in poses[1:]:
        dx_m, dy_m = now[0] - last[0], now[1] - last[1]
        forward_m = math.cos(last[2]) * dx_m + math.sin(last[2]) * dy_m
        left_m = math.cos(last[2]) * dy_m - math.sin(last[2]) * dx_m
        length_m = math.hypot(dx_m, dy_m)
        path_m += length_m
        turn_rad = change.turns * wrapped(now[2] - last[2])
        turn_rad += math.radians(change.drift_deg_per_m) * math.copysign(length_m, forward_m)
        if path_m > next_turn_m:
            next_turn_m += BETWEEN_RANDOM_TURNS_M
            turn_rad += math.radians(chance.gauss(0.0, change.random_turns_deg))
        if change.noise:
            way, turned = math.sqrt(length_m), math.sqrt(abs(wrapped(now[2] - last[2])))
            turn_rad += change.noise * chance.gauss(0.0, math.hypot(NOISE_YAW_RAD_PER_SQRT_M * way,
                                                                    NOISE_YAW_RAD_PER_SQRT_RAD * turned))
            forward_m += change.noise * chance.gauss(0.0, NOISE_XY_M_PER_SQRT_M * way)
            left_m += change.noise * chance.gauss(0.0, NOISE_XY_M_PER_SQRT_M * way)
        x_m += change.metres * (math.cos(yaw_rad) * forward_m - math.sin(yaw_rad) * left_m)
        y_m += change.metres * (math.sin(yaw_rad) * forward_m + math.cos(yaw_rad) * left_m)
        yaw_rad = wrapped(yaw_rad + turn_rad)
        last = now
        found.append((stamp, (x_m, y_m, yaw_rad)))
    return found


def write(recording, change, target):
    """Writes the changed copy, plain."""
    turned = cut(turned_round(recording, change), change)
    times = regular_times([stamp for stamp, _ in turned.poses]) if recording.is_odometry_in_scans else None
    measured = with_errors(ahead(turned.poses, change.lead_s, times), change)
    poses = [(stamp, f"{x:.6f} {y:.6f} {yaw:.6f}") for stamp, (x, y, yaw) in measured]
    unsaid = "0 0 0"
    if recording.is_odometry_in_scans:
        beside, lines = [pose for _, pose in poses], []
    else:
        beside, lines = [unsaid] * len(turned.scans), [(stamp, f"ODOM {pose} {unsaid}") for stamp, pose in poses]
    lines += [(stamp + recording.scan_delay_s(), f"FLASER {len(ranges)} {' '.join(ranges)} {unsaid} {pose}")
              for (stamp, ranges), pose in zip(turned.scans, beside)]
    with open(target, "w", encoding="latin-1") as file:
        for stamp, line in sorted(lines, key=lambda line: line[0]):
            file.write(f"{line} {stamp:.6f} changed {stamp:.6f}\n")


def lead_back(trajectory, recording, change, target):
    """Transforms a trajectory (TUM) mapped from the changed copy to one of the log, and writes it."""
    side = -1 if change.mirrored else 1
    rows = []
    for line in trajectory.read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            continue
        stamp, x, y, _, _, _, qz, qw = map(float, line.split())
        measured = stamp - recording.scan_delay_s()
        was_measured = recording.ends_s() - measured if change.backwards else measured
        rows.append((was_measured + recording.scan_delay_s(),
                     f"{x:.6f} {side * y:.6f} 0 0 0 {side * qz:.9f} {qw:.9f}"))
    target.write_text("".join(f"{stamp:.6f} {pose}\n" for stamp, pose in sorted(rows)), encoding="utf-8")

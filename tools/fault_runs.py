# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The runs that `tools/benchmark-faults` makes, and their figures."""

import dataclasses
import math
import tempfile
from pathlib import Path

import log_sharpness
import mapped_runs
import whole_runs

WORLDS = ["office", "maze"]
SEEDS = 10  # of each world, from 1 on
BREAK_S = 150  # after the first sample
NEAR_M = 0.5  # within which a live pose counts as found back


@dataclasses.dataclass(frozen=True)
class Fault:
    kind: str  # of `sim://`; or none
    amount: int | None = None  # s, or deg of a jump

    def text(self):
        if self.kind == "none":
            return self.kind
        return f"{self.kind}@{BREAK_S}" + ("" if self.amount is None else f":{self.amount}")

    def is_told(self):
        """Whether the input shows that motion broke. A flight without a break counts, for comparison."""
        return self.kind in ("none", "silence", "reset", "restart", "carried")

    def end_s(self):
        """After the first sample, by the stamps of the files: what a restart takes is not in them as flight."""
        return BREAK_S + (self.amount if self.kind in ("silence", "carried") else 0)


FAULTS = [Fault("none"), Fault("silence", 20), Fault("silence", 31), Fault("silence", 60), Fault("reset"),
          Fault("restart", 60), Fault("carried", 30), Fault("carried", 60), Fault("jump", 10), Fault("jump", 20),
          Fault("jump", 30), Fault("slip", 6), Fault("teleport", 20)]


@dataclasses.dataclass(frozen=True)
class Run:
    log: mapped_runs.Log
    fault: Fault
    change: None = None

    def title(self):
        return self.log.source


def run_of(world, seed, fault):
    breaks = "" if fault.kind == "none" else f"&fault={fault.text()}"
    return Run(mapped_runs.Log(world, f"sim://{world}?seed={seed}{breaks}", None), fault)


def all_runs(seeds=SEEDS):
    """Seed by seed, so that runs that are interrupted are of all worlds and faults."""
    return [run_of(world, seed, fault) for seed in range(1, seeds + 1) for world in WORLDS for fault in FAULTS]


def onto(pairs):
    """The rigid motion of the plane that puts the first positions of the pairs onto the second, by least squares.
    Positions are complex numbers, m."""
    centre_from = sum(a for a, _ in pairs) / len(pairs)
    centre_to = sum(b for _, b in pairs) / len(pairs)
    turn = sum((a - centre_from).conjugate() * (b - centre_to) for a, b in pairs)
    turn /= abs(turn)
    return lambda position: centre_to + turn * (position - centre_from)


def way_back_m(truth, live, break_s, end_s):
    """The way flown from the end of a break until the live pose stays within NEAR_M of the truth; None where it is
    farther off at the end of the flight. The live poses before the break are put onto the truth. Poses: by stamp in ms,
    as of log_sharpness.poses_of(); times: after the first of the truth."""
    start = min(truth)
    true = {stamp: complex(*pose[:2]) for stamp, pose in sorted(truth.items())}
    published = {stamp: complex(*pose[:2]) for stamp, pose in live.items() if stamp in true}
    placed = onto([(position, true[stamp]) for stamp, position in published.items() if stamp < start + 1e3 * break_s])
    after = [stamp for stamp in true if stamp >= start + 1e3 * end_s]
    flown_m, back_m = 0.0, None
    for before, stamp in zip([after[0], *after], after):
        flown_m += abs(true[stamp] - true[before])
        if stamp not in published:
            continue
        if abs(placed(published[stamp]) - true[stamp]) > NEAR_M:
            back_m = None
        elif back_m is None:
            back_m = flown_m
    return back_m


class Results(mapped_runs.Results):
    def executed(self, run):
        """The final error and, where the fault is told, the way until the vehicle found back."""
        with tempfile.TemporaryDirectory() as name:
            report = whole_runs.run(self.swiftlet, [run.log.source], name)
            truth, live = (log_sharpness.poses_of(Path(name, file)) for file in ("ground_truth.tum", "live.tum"))
        figures = {"final_m": report["absolute_trajectory_error"]["corrected"]["rmse_m"]}
        if run.fault.is_told():
            figures["way_back_m"] = way_back_m(truth, live, BREAK_S, run.fault.end_s())
        return figures

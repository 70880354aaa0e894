# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The runs that `tools/benchmark-faults` makes, and their figures."""

import dataclasses
import json
import math
import statistics
import sys
import tempfile
from pathlib import Path

import benchmark_page as page
import doubt_runs
import log_sharpness
import mapped_runs
import whole_runs

WORLDS = ["office", "maze"]
STOREYS = "storeys"  # nothing breaks there: the vehicle flies up the stairs, and back
SEEDS = 10  # of each world, from 1 on
BREAK_S = 150  # after the first sample: much of the world is known
EARLY_S = 80  # likewise: most of it is not
SHORT_SILENCE_S = 2
NEAR_M = 0.5  # within which a live pose is right again, and counts as found back...
STAYS_M = 5.0  # ...if it stays so for this way...
LEAST_STAY_M = 1.0  # ...or to the end of the run, for this at least
WRONG_M = 1.0
WRONG_WAY_M = 5.0  # a final path that is beyond WRONG_M over more than this believes a wrong place
SURE = "tracking"  # the published state of a good pose
GAP_S = 1.0  # between moments: old ground was out of reach


@dataclasses.dataclass(frozen=True)
class Fault:
    kind: str  # of `sim://`; or none
    amount: int | None = None  # s, or deg of a jump or turn
    silent_at_s: int | None = None  # before or behind the break, for SHORT_SILENCE_S
    at_s: int = BREAK_S

    def text(self):
        if self.kind == "none":
            return self.kind
        text = f"{self.kind}@{self.at_s}" + ("" if self.amount is None else f":{self.amount}")
        if self.silent_at_s is None:
            return text
        silence = f"silence@{self.silent_at_s}:{SHORT_SILENCE_S}"
        return f"{silence},{text}" if self.silent_at_s < self.at_s else f"{text},{silence}"

    def is_told(self):
        """Whether the input shows that motion broke. A flight without a break counts, for comparison."""
        return self.kind in ("none", "silence", "reset", "restart", "carried", "jump")

    def end_s(self):
        """After the first sample, by the stamps of the files: what a restart takes is not in them as flight."""
        return self.at_s + (self.amount if self.kind in ("silence", "carried") else 0)


FAULTS = [Fault("none"), Fault("silence", 20), Fault("silence", 31), Fault("silence", 60), Fault("reset"),
          Fault("restart", 60), Fault("restart", 60, at_s=EARLY_S), Fault("carried", 30), Fault("carried", 60),
          Fault("carried", 60, silent_at_s=214), Fault("jump", 10), Fault("jump", 20),
          Fault("jump", 30), Fault("turn", 20), Fault("turn", 30), Fault("turn", 30, silent_at_s=20),
          Fault("slip", 6), Fault("teleport", 20)]


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
    kinds = [(world, fault) for world in WORLDS for fault in FAULTS] + [(STOREYS, Fault("none"))]
    return [run_of(world, seed, fault) for seed in range(1, seeds + 1) for world, fault in kinds]


def flown_m(truth):
    """{stamp in ms: way flown since the first pose, m}. `truth`: as log_sharpness.poses_of() has it."""
    ways, before, way = {}, None, 0.0
    for stamp, (x_m, y_m, _) in sorted(truth.items()):
        way += 0.0 if before is None else math.dist(before, (x_m, y_m))
        ways[stamp] = way
        before = (x_m, y_m)
    return ways


def counted_m(samples):
    """The way to each sample that counts from the one before. `samples`: (stamp_s, way_m, counts), in order."""
    return sum(b_m - a_m for (a_s, a_m, _), (b_s, b_m, counts) in zip(samples, samples[1:])
               if counts and b_s - a_s < GAP_S)


@dataclasses.dataclass(frozen=True)
class Moment:
    """A sample behind the break, over ground that was mapped long before."""
    stamp_s: float
    way_m: float
    error_m: float  # of the published pose, against the map around it as it stood then
    state: str


def moments(evaluation, truth, end_s):
    """Those since the end of the break, in order. `evaluation`: what `swiftlet eval --live --json` writes."""
    ways = flown_m(truth)
    states = {round(row[0] * 1e3): row[6] for row in evaluation["poses"]}
    errors = {round(stamp_s * 1e3): error_m for stamp_s, error_m in evaluation["live"]["errors_m"]}
    begin = min(truth) + 1e3 * end_s
    return [Moment(1e-3 * stamp, ways[stamp], error_m, states[stamp])
            for stamp, error_m in sorted(errors.items()) if stamp >= begin]


def way_back_m(after):
    """The way flown from the first old ground behind the break until the published pose is within NEAR_M of its place
    for STAYS_M, or to the end of the run for LEAST_STAY_M; None where that never happens. `after`: moments over
    that way at least."""
    back_m = None
    for moment in after:
        if moment.error_m > NEAR_M:
            back_m = None
        elif back_m is None:
            back_m = moment.way_m
        if back_m is not None and moment.way_m - back_m >= STAYS_M:
            break
    return None if back_m is None or moment.way_m - back_m < LEAST_STAY_M else back_m - after[0].way_m


def doubted_s(evaluation):
    """The stamps of the poses published in doubt, at known places or not. `evaluation`: as for moments()."""
    return [1e-3 * round(row[0] * 1e3) for row in evaluation["poses"] if row[6] != SURE]


def noticed_s(after, doubted):
    """From the first moment with an error beyond WRONG_M until the next pose in doubt; 0 where it is itself, None where
    none is before the error has fallen below NEAR_M, as count_alarms() in core/evaluation has it. `after`: moments of
    which one is beyond WRONG_M. `doubted`: as doubted_s() has them."""
    wrong_s = next(moment.stamp_s for moment in after if moment.error_m > WRONG_M)
    right_s = next((moment.stamp_s for moment in after if moment.stamp_s > wrong_s and moment.error_m < NEAR_M),
                   math.inf)
    return next((stamp_s - wrong_s for stamp_s in doubted if wrong_s <= stamp_s <= right_s), None)


def believed_m(after):
    """The way flown while a pose beyond WRONG_M was published as good."""
    return counted_m([(moment.stamp_s, moment.way_m, moment.state == SURE and moment.error_m > WRONG_M)
                      for moment in after])


def path_figures(final, truth, fault):
    """Of the final path, put onto the truth by what was flown before the break: a fit of the whole would share the error
    out. The error before, and the way behind over which it is beyond WRONG_M. `final`, `truth`: as
    log_sharpness.poses_of() has them."""
    start, ways = min(truth), flown_m(truth)
    pairs = {stamp: (complex(*final[stamp][:2]), complex(*truth[stamp][:2])) for stamp in sorted(final.keys() & truth)}
    before = [pair for stamp, pair in pairs.items() if stamp < start + 1e3 * fault.at_s]
    placed = doubt_runs.onto(before)
    wrong_m = counted_m([(1e-3 * stamp, ways[stamp], abs(placed(mapped) - true) > WRONG_M)
                         for stamp, (mapped, true) in pairs.items() if stamp >= start + 1e3 * fault.end_s()])
    return {"before_m": math.sqrt(statistics.fmean(abs(placed(mapped) - true)**2 for mapped, true in before)),
            "wrong_way_m": wrong_m}


def figures(fault, after, doubted):
    """Of the live pose in a run with these moments behind the break. Figures that mean nothing in it are absent."""
    result = {}
    if after and after[-1].way_m - after[0].way_m >= LEAST_STAY_M:
        result |= {"way_back_m": way_back_m(after), "believed_m": believed_m(after)}
    if not fault.is_told() and any(moment.error_m > WRONG_M for moment in after):
        result["noticed_s"] = noticed_s(after, doubted)
    return result


class Results(mapped_runs.Results):
    modules = (sys.modules[__name__], doubt_runs, log_sharpness)

    def executed(self, run):
        """The errors of the final path, and figures()."""
        with tempfile.TemporaryDirectory() as name:
            report = whole_runs.run(self.swiftlet, [run.log.source], name)
            final, truth = (log_sharpness.poses_of(Path(name, file)) for file in ("trajectory.tum", "ground_truth.tum"))
        evaluation = json.loads(page.run(str(self.swiftlet), "eval", "--live", run.log.source, "--json", "-"))
        return {"final_m": report["absolute_trajectory_error"]["corrected"]["rmse_m"],
                **path_figures(final, truth, run.fault),
                "doubted_s": evaluation["consistency"]["seconds_doubted"],
                **figures(run.fault, moments(evaluation, truth, run.fault.end_s()), doubted_s(evaluation))}

# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""docs/results/sensor_errors.md: what each error of the simulated sensors costs, and the runs that show it."""

import dataclasses
import math
import statistics
import sys
import tempfile
from pathlib import Path

import benchmark_page as page
import mapped_runs
import whole_runs

SEEDS = range(120)  # for development: nothing is judged by them
NONE = ""
ERRORS = ["floors", "slips", "scale", "wander", "flow", "drift", "walk", "jumps", "sign", "ranges", "tilt", "lag"]
TOGETHER = {"floors,slips,scale,wander,flow": "all of the flow", "drift,walk,jumps": "all of the heading",
            "ranges,tilt,lag": "all of the ranges"}
PATHS = {"odometry": "dead reckoning", "live": "published", "corrected": "final"}
TAIL = 1.96  # of the normal distribution, 95 % to both sides
WORSE = 1.02  # than dead reckoning


@dataclasses.dataclass(frozen=True)
class Run:
    seed: int
    without: str
    change: None = None

    @property
    def log(self):
        spared = self.without and f"&without={self.without}"
        return mapped_runs.Log("building", f"sim://building?seed={self.seed}{spared}", None)

    def title(self):
        return self.log.source


def all_runs(seeds=SEEDS):
    return [Run(seed, without) for without in (NONE, *ERRORS, *TOGETHER) for seed in seeds]


class Results(mapped_runs.Results):
    modules = (sys.modules[__name__],)

    def executed(self, run):
        """By path its RMS error in metres."""
        with tempfile.TemporaryDirectory() as name:
            report = whole_runs.run(self.swiftlet, [run.log.source], Path(name, "out"))
        return {path: report["absolute_trajectory_error"][path]["rmse_m"] for path in PATHS}


def change(spared, usual):
    """Of errors by seed: their geometric mean as a multiple, with its 95 % interval."""
    logs = [math.log(spared[seed] / usual[seed]) for seed in usual]
    mean = statistics.mean(logs)
    off = TAIL * statistics.stdev(logs) / math.sqrt(len(logs))
    return f"{math.exp(mean):.2f} ({math.exp(mean - off):.2f} to {math.exp(mean + off):.2f})"


def table(rows):
    by_error = {}
    for run, result in rows:
        by_error.setdefault(run.without, {})[run.seed] = result
    usual = by_error[NONE]
    lines = []
    for without, results in by_error.items():
        multiples = [change({seed: result[path] for seed, result in results.items()},
                            {seed: result[path] for seed, result in usual.items()})
                     for path in PATHS] if without else ["1"] * len(PATHS)
        ratios = [result["corrected"] / result["odometry"] for result in results.values()]
        name = f"{TOGETHER[without]} (`{without}`)" if without in TOGETHER else f"`{without}`" if without else "none"
        lines.append([name, *multiples, f"{statistics.median(ratios):.3f}",
                      f"{page.quantile([result['corrected'] for result in results.values()], .5):.3f}",
                      str(sum(ratio > WORSE for ratio in ratios))])
    return page.table(["spared", *(f"{name}:" for name in PATHS.values()), "final over dead reckoning, median:",
                       "final, median, m:", "worse:"], lines)


def document(report):
    return f"""{page.head("What each error of the sensors costs", "benchmark-sensor-errors", report)}
The [simulated buildings](../simulated_buildings.md#errors) with seeds {SEEDS.start} to {SEEDS.stop - 1}, each mapped as
it is and spared one error of its sensors (`without` in the URI); all else is the same. "Dead reckoning", "published"
and "final" are the RMS errors of these paths as multiples of those with all errors: geometric means over the buildings,
with 95 % intervals. "Worse" are maps that are more than 2 % worse than their dead reckoning.

Where the published and final error hardly change, that error is estimated from the input, averaged out, or small
beside the others. Where they change, it is what limits the maps.

{table(report["rows"])}
"""

# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The runs that `tools/benchmark-sensor-errors` makes, and what it takes from them."""

import dataclasses
import json
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


def runs_from_truth(seeds=SEEDS):
    return [Run(seed, without) for without in (NONE, "floors") for seed in seeds]


class Results(mapped_runs.Results):
    modules = (sys.modules[__name__],)

    def executed(self, run):
        """By path its RMS error in metres."""
        with tempfile.TemporaryDirectory() as name:
            report = whole_runs.run(self.swiftlet, [run.log.source], Path(name, "out"))
        return {path: report["absolute_trajectory_error"][path]["rmse_m"] for path in PATHS}


class ResultsFromTruth(mapped_runs.Results):
    """Of tests/benchmarks/refined_truth.cpp."""

    modules = (sys.modules[__name__],)

    def executed(self, run):
        return json.loads(page.run(str(self.swiftlet), run.log.source))

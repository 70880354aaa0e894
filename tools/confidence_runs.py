# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The runs that `tools/benchmark-confidence` makes, and what it takes from them."""

import dataclasses
import json
import sys
import tempfile
from pathlib import Path

import benchmark_page as page
import fault_runs
import mapped_runs
import whole_runs

BUILDINGS = range(1000, 1100)  # seeds that nothing was set on
HEALTHY_WORLDS = ["office", "maze", "corridors", "loop", "wings"]
HEALTHY_SEEDS = 27  # of each world; with the buildings more than 20 hours
FAULTS = [fault_runs.Fault("turn", 20), fault_runs.Fault("turn", 30), fault_runs.Fault("slip", 6),
          fault_runs.Fault("teleport", 20)]
FAULT_SEEDS = 10
FLIGHTS = [f"vicon/{name}" for name in ("exp1_two_d0", "exp1_two_d1", "exp1_four_d0", "exp1_four_d1", "exp1_four_d2",
                                        "exp1_four_d3", "exp3_two_d0", "exp3_two_d1", "icp_d0", "icp_d1")]
UNTRUE_FLIGHTS = ["flights/olsson", "flights/rice"]  # held against their own final path
ALARM = "alarm_log_odds"
THRESHOLDS = [10.0, 36.0]  # besides the default, for buildings, healthy offices and mazes, and faults


@dataclasses.dataclass(frozen=True)
class Run:
    log: mapped_runs.Log
    kind: str  # building, healthy, flight, or the text of a fault
    threshold: float | None = None  # None: the default
    change: None = None

    def title(self):
        return self.log.source + ("" if self.threshold is None else f", {ALARM} {self.threshold:g}")


def simulated(world, kind, threshold=None):
    return Run(mapped_runs.Log(world.split("?", maxsplit=1)[0], f"sim://{world}", None), kind, threshold)


def roc_runs(threshold, buildings, fault_seeds):
    runs = [simulated(f"building?seed={seed}", "building", threshold) for seed in buildings]
    for world in fault_runs.WORLDS:
        for seed in range(1, fault_seeds + 1):
            runs.append(simulated(f"{world}?seed={seed}", "healthy", threshold))
            runs += [simulated(f"{world}?seed={seed}&fault={fault.text()}", fault.text(), threshold)
                     for fault in FAULTS]
    return runs


def all_runs(buildings=BUILDINGS, healthy_seeds=HEALTHY_SEEDS, fault_seeds=FAULT_SEEDS):
    runs = roc_runs(None, buildings, fault_seeds)
    runs += [simulated(f"{world}?seed={seed}", "healthy") for world in HEALTHY_WORLDS
             for seed in range(1, healthy_seeds + 1) if world not in fault_runs.WORLDS or seed > fault_seeds]
    runs += [Run(mapped_runs.Log(name, f"{name}.pcap", f"{name}_vicon.tum"), "flight") for name in FLIGHTS]
    runs += [Run(mapped_runs.Log(name, f"{name}.pcap", f"{name}.pcap"), "flight") for name in UNTRUE_FLIGHTS]
    for threshold in THRESHOLDS:
        runs += roc_runs(threshold, buildings, fault_seeds)
    return runs


class Results(mapped_runs.Results):
    modules = (sys.modules[__name__],)

    def executed(self, run):
        """The object `consistency` of the report."""
        if run.kind == "flight":
            return self.executed_flight(run)
        with tempfile.TemporaryDirectory() as name:
            config = Path(name, "settings.toml")
            tuning = "" if run.threshold is None else f"[tuning.backend_confidence]\n{ALARM} = {run.threshold}\n"
            config.write_text(tuning, encoding="utf-8")
            report = whole_runs.run(self.swiftlet, [run.log.source, "--config", str(config)], Path(name, "out"))
        return report["consistency"]

    def executed_flight(self, run):
        truth = [] if run.log.reference == run.log.source else [str(mapped_runs.DATASETS / run.log.reference)]
        said = page.run(str(self.swiftlet), "eval", "--consistency", str(mapped_runs.DATASETS / run.log.source), *truth,
                        "--json", "-")
        return json.loads(said)["consistency"]

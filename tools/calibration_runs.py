# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Runs of `swiftlet calibrate` and the truth about them: the list, and their results."""

import dataclasses
import json
import subprocess
import time

import accuracy_runs
import mapped_runs
import wheels_by_relations
import whole_runs
from mapped_runs import Log


@dataclasses.dataclass(frozen=True)
class Flight:
    """One of tests/benchmarks/calibration_flights."""
    seed: int
    sensors: tuple[float, ...] = ()  # range age in ms, spread of scale and turn scale; none: the default ones


@dataclasses.dataclass(frozen=True)
class Input:
    log: Log
    beams: int | None = None  # laser logs only

    def name(self):
        return self.log.name if self.beams is None else f"{self.log.name}, {self.beams} beams"

    def arguments(self):
        source = self.log.source if self.log.reference is None else str(mapped_runs.DATASETS / self.log.source)
        return [source] if self.beams is None else [source, "--beams", str(self.beams)]


DEFAULT_FLIGHTS = [Flight(seed) for seed in range(1, 6)]
OTHER_FLIGHTS = [Flight(seed, (age_ms, 0.1, 0.05)) for seed, age_ms in enumerate((20, 60, 100, 40, 130), 11)]
OFFICES = [Input(log) for log in accuracy_runs.OFFICES]
LOGS = [Input(accuracy_runs.OLSSON), Input(accuracy_runs.RICE), Input(accuracy_runs.ACES, 11),
        Input(accuracy_runs.INTEL, 11)]
AGED = LOGS[:3]  # Intel's stamps come in bunches
AGES_S = [0.0, 0.04, 0.06, 0.08, 0.1, 0.12, 0.14]


def said(*command):
    """The command's stdout. Raises OSError, or subprocess.CalledProcessError with the command's stderr."""
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def fly(flight, program):
    """Raises as said() does, or ValueError."""
    return json.loads(said(program, flight.seed, *flight.sensors))


def mapped(swiftlet, wanted, options, output):
    """Live and final trajectory, evaluated by the reference. Raises as said() does, or ValueError."""
    whole_runs.run(swiftlet, [*wanted.arguments(), *options], output)
    reference = output / "ground_truth.tum" if wanted.log.reference is None else (
        mapped_runs.DATASETS / wanted.log.reference)
    return {which: mapped_runs.judge(swiftlet, output / mapped_runs.TRAJECTORIES[which], reference)
            for which in ("live", "final")}


def as_set(config):
    """Options that map with these settings and estimate nothing before."""
    return ["--no-calibrate", "--config", str(config)]


def calibrate(wanted, swiftlet, folder):
    """The findings and the seconds they took, the maps without and with the file written and by default, and the
    wheels by relations. `folder`: is filled. Raises as mapped() does."""
    found = folder / "found.toml"
    begun = time.monotonic()
    calibration = json.loads(said(swiftlet, "calibrate", *wanted.arguments(), "--json", "-o", found))
    result = {"calibration": calibration,
              "seconds": time.monotonic() - begun,
              "without": mapped(swiftlet, wanted, ["--no-calibrate"], folder / "without"),
              "with": mapped(swiftlet, wanted, as_set(found), folder / "with"),
              "default": mapped(swiftlet, wanted, [], folder / "default"),
              "wheels": None}
    if wanted.log in accuracy_runs.LASER_LOGS:
        result["wheels"] = wheels_by_relations.estimate(mapped_runs.DATASETS / wanted.log.reference,
                                                        folder / "without" / mapped_runs.TRAJECTORIES["odometry"])
    return result


def map_at(age_s, wanted, swiftlet, folder):
    """The map with this age of the ranges. Otherwise as calibrate()."""
    config = folder / "age.toml"
    config.write_text(mapped_runs.configuration({"sensor": {"range_age_s": age_s}}), encoding="utf-8")
    return mapped(swiftlet, wanted, as_set(config), folder / "out")

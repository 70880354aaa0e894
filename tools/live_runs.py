# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The runs that `tools/benchmark-live` makes, and their figures."""

import dataclasses
import json
import subprocess

import accuracy_runs
import mapped_runs

WORLDS = ["office", "loop", "corridors", "maze", "wings", "patrol"]
SEEDS = range(1, 11)
OPTIONS = {"patrol": "&laps=5"}  # a single lap meets no old ground
BATCH_EVERY_S = 20
BATCH_EVERY_S_RECORDED = 8  # there are two


@dataclasses.dataclass(frozen=True)
class Flight:
    world: str  # or the recording's name
    source: str  # URI, or file of the data sets
    is_recorded: bool = False

    def arguments(self):
        if self.is_recorded:
            return [str(mapped_runs.DATASETS / self.source), "--batch", str(BATCH_EVERY_S_RECORDED)]
        return [self.source, "--batch", str(BATCH_EVERY_S)]

    def is_missing(self):
        return self.is_recorded and not (mapped_runs.DATASETS / self.source).exists()


SIMULATED = [Flight(world, f"sim://{world}?seed={seed}{OPTIONS.get(world, '')}") for world in WORLDS for seed in SEEDS]
RECORDED = [Flight(log.name, log.source, is_recorded=True) for log in (accuracy_runs.OLSSON, accuracy_runs.RICE)]


def evaluate(flight, swiftlet, config=None):
    """The figures of `swiftlet eval --live`. Raises OSError, ValueError or subprocess.CalledProcessError."""
    settings = [] if config is None else ["--config", str(config)]
    command = [str(swiftlet), "eval", "--live", *flight.arguments(), *settings, "--json", "-"]
    figures = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    figures.pop("poses", None)
    return {"world": flight.world, "is_recorded": flight.is_recorded, **figures}

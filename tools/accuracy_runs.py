# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The runs that `tools/benchmark-accuracy` makes."""

import dataclasses
import json

import mapped_runs
from changed_log import Change
from mapped_runs import Log

BEAMS = [4, 6, 9, 11, 13, 30, 60]
KERNELS = [1, 3, 5, 7]
MULTISCANS = [92, 100, 108, 116, 124, 132]
CHANGED_BEAMS = [11, 4]
CHANGES = [
    Change("backwards", backwards=True),
    Change("mirrored", mirrored=True),
    Change("turns 4 % long", turns=1.04),
    Change("turns 4 % short", turns=0.96),
    Change("metres 3 % long", metres=1.03),
    Change("drift 0.5 deg/m left", drift_deg_per_m=0.5),
    Change("drift 0.5 deg/m right", drift_deg_per_m=-0.5),
    Change("random turns of 6 deg, seed 1", random_turns_deg=6.0, seed=1),
    Change("random turns of 6 deg, seed 2", random_turns_deg=6.0, seed=2),
    Change("backwards, with random turns of 6 deg", backwards=True, random_turns_deg=6.0, seed=3),
]


ACES = Log("ACES", "radish/aces.clf.gz", "radish/aces.relations")
INTEL = Log("Intel", "radish/intel.clf.gz", "radish/intel.relations")
KILLIAN = Log("Killian", "radish/mit-killian.clf.gz", "radish/mit-killian.relations", lines_ahead=1)
OLSSON = Log("Olsson Hall", "flights/olsson.pcap", "flights/olsson.pcap")
RICE = Log("Rice Hall", "flights/rice.pcap", "flights/rice.pcap")
LASER_LOGS = [ACES, INTEL, KILLIAN]
SWEPT_LOGS = [ACES, INTEL]
FLIGHTS = [OLSSON, RICE]
OFFICES = [Log(f"office, seed {seed}", f"sim://office?seed={seed}", None) for seed in range(1, 6)]


@dataclasses.dataclass(frozen=True)
class Run:
    log: Log
    beams: int | None = None  # laser logs only
    refine: bool = True
    kernel: int | None = None  # None: as configured by default, like the next
    multiscan: int | None = None
    change: Change | None = None  # laser logs only

    def settings(self):
        """The differences from the defaults: keys of the configuration, by section."""
        backend = {} if self.refine else {"refine": False}
        if self.kernel is not None:
            backend["max_kernel_cells"] = self.kernel
        frontend = {} if self.multiscan is None else {"multiscan_points": self.multiscan}
        return {name: keys for name, keys in (("frontend", frontend), ("backend", backend)) if keys}

    def configuration(self):
        return mapped_runs.configuration(self.settings())

    def title(self):
        beams = [] if self.beams is None else [f"{self.beams} beams"]
        keys = [f"{key} {json.dumps(value)}" for section in self.settings().values() for key, value in section.items()]
        change = [] if self.change is None else [self.change.name]
        return ", ".join([self.log.name, *change, *beams, *keys])


def both(**choices):
    """Without refinement, and with it."""
    return [Run(refine=refine, **choices) for refine in (False, True)]


def kernel_run(kernel, **choices):
    """The default kernel is a run of another part."""
    return Run(kernel=None if kernel == 3 else kernel, **choices)


PARTS = {
    "table": [run for log in LASER_LOGS for beams in (11, 4) for run in both(log=log, beams=beams)]
             + [Run(log) for log in FLIGHTS + OFFICES],
    "beams": [run for log in SWEPT_LOGS for beams in BEAMS for run in both(log=log, beams=beams)],
    "kernel": [kernel_run(kernel, log=log, beams=beams, refine=refine)
               for log in SWEPT_LOGS for beams in (4, 11) for refine in (False, True) for kernel in KERNELS],
    "multiscan": [run for log in SWEPT_LOGS for beams in (4, 11) for points in MULTISCANS
                  for run in both(log=log, beams=beams, multiscan=points)],
    "changed": [Run(log, beams=beams, change=change)
                for log in LASER_LOGS for beams in CHANGED_BEAMS for change in (None, *CHANGES)],
    "times": [Run(log, beams=11) for log in LASER_LOGS],
}


def runs_of(parts):
    """The runs of these parts, each once."""
    return list(dict.fromkeys(run for part in parts for run in PARTS[part]))

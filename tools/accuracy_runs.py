# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Runs of `swiftlet map` judged by `swiftlet eval`: which there are, and what came of them, kept for each build."""

import dataclasses
import hashlib
import json
import os
import re
import tempfile
from pathlib import Path

import benchmark_page as page
import whole_runs

DATASETS = Path(os.environ.get("SWIFTLET_DATASETS", page.ROOT.parent / "shared/datasets"))
TRAJECTORIES = {"odometry": "odometry.tum", "live": "live.tum", "final": "trajectory.tum"}
BEAMS = [4, 6, 9, 11, 13, 30, 60]
KERNELS = [1, 3, 5, 7]
MULTISCANS = [92, 100, 108, 116, 124, 132]


@dataclasses.dataclass(frozen=True)
class Log:
    name: str
    source: str  # file of the data sets, or URI
    reference: str | None  # file of the data sets; None: the true path that the run itself writes

    def missing(self):
        """Its files that are not there."""
        files = [] if self.reference is None else sorted({self.source, self.reference})
        return [file for file in files if not (DATASETS / file).exists()]


ACES = Log("ACES", "radish/aces.clf.gz", "radish/aces.relations")
INTEL = Log("Intel", "radish/intel.clf.gz", "radish/intel.relations")
KILLIAN = Log("Killian", "radish/mit-killian.clf.gz", "radish/mit-killian.relations")
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

    def settings(self):
        """What differs from the defaults: keys of the configuration, by section."""
        backend = {} if self.refine else {"refine": False}
        if self.kernel is not None:
            backend["max_kernel_cells"] = self.kernel
        frontend = {} if self.multiscan is None else {"multiscan_points": self.multiscan}
        return {name: keys for name, keys in (("frontend", frontend), ("backend", backend)) if keys}

    def title(self):
        beams = [] if self.beams is None else [f"{self.beams} beams"]
        keys = [f"{key} {json.dumps(value)}" for section in self.settings().values() for key, value in section.items()]
        return ", ".join([self.log.name, *beams, *keys])


def both(**choices):
    """Without refinement, and with it."""
    return [Run(refine=refine, **choices) for refine in (False, True)]


def kernel_run(kernel, **choices):
    """The default is a run that there is already."""
    return Run(kernel=None if kernel == 3 else kernel, **choices)


PARTS = {
    "table": [run for log in LASER_LOGS for beams in (11, 4) for run in both(log=log, beams=beams)]
             + [Run(log) for log in FLIGHTS + OFFICES],
    "beams": [run for log in SWEPT_LOGS for beams in BEAMS for run in both(log=log, beams=beams)],
    "kernel": [kernel_run(kernel, log=log, beams=beams, refine=refine)
               for log in SWEPT_LOGS for beams in (4, 11) for refine in (False, True) for kernel in KERNELS],
    "multiscan": [run for log in SWEPT_LOGS for beams in (4, 11) for points in MULTISCANS
                  for run in both(log=log, beams=beams, multiscan=points)],
    "times": [Run(log, beams=11) for log in LASER_LOGS],
}


def runs_of(parts):
    """The runs of these parts, each once."""
    return list(dict.fromkeys(run for part in parts for run in PARTS[part]))


def configuration(settings):
    """TOML."""
    return "".join(f"[{section}]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items())
                   for section, keys in settings.items())


def judge(swiftlet, trajectory, reference):
    """What `swiftlet eval` finds, as JSON has it; None where the run wrote no such trajectory."""
    if not trajectory.exists():
        return None
    said = page.run(str(swiftlet), "eval", str(trajectory), str(reference), "--json", "-")
    [figures] = json.loads(said)["references"]
    return figures


def execute(run, swiftlet):
    """Maps and judges. Raises OSError or subprocess.CalledProcessError."""
    with tempfile.TemporaryDirectory() as name:
        output = Path(name, "out")
        config = Path(name, "settings.toml")
        config.write_text(configuration(run.settings()), encoding="utf-8")
        source = run.log.source if run.log.reference is None else str(DATASETS / run.log.source)
        beams = [] if run.beams is None else ["--beams", str(run.beams)]
        report = whole_runs.run(swiftlet, [source, *beams, "--config", str(config)], output)
        reference = output / "ground_truth.tum" if run.log.reference is None else DATASETS / run.log.reference
        judged = {which: judge(swiftlet, output / file, reference) for which, file in TRAJECTORIES.items()}
    return {"report": report, **judged}


class Results:
    """What came of the runs of one build of the program, one file for each."""

    def __init__(self, folder, swiftlet):
        self.folder = folder
        self.swiftlet = swiftlet
        self.program = hashlib.sha256(Path(swiftlet).read_bytes()).hexdigest()[:12]

    def _file(self, run):
        name = re.sub("[^A-Za-z0-9]+", "-", run.title())
        return self.folder / f"{name}_{self.program}.json"

    def get(self, run):
        """None where the run has not been made."""
        try:
            return json.loads(self._file(run).read_text(encoding="utf-8"))
        except FileNotFoundError:
            return None

    def make(self, run, at_once):
        """`at_once`: how many runs share the machine. Raises as execute() does."""
        result = {"run": run.title(), "program": self.program, "at_once": at_once, **execute(run, self.swiftlet)}
        self.folder.mkdir(parents=True, exist_ok=True)
        begun = self._file(run).with_suffix(".part")
        begun.write_text(json.dumps(result, indent=1), encoding="utf-8")
        begun.replace(self._file(run))  # whole or not at all, however this ends

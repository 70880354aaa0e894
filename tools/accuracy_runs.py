# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Runs of `swiftlet map` evaluated by `swiftlet eval`: the list, and their results, kept for each build."""

import dataclasses
import hashlib
import json
import os
import re
import tempfile
from pathlib import Path

import benchmark_page as page
import changed_log
import whole_runs
from changed_log import Change

DATASETS = Path(os.environ.get("SWIFTLET_DATASETS", page.ROOT.parent / "shared/datasets"))
TRAJECTORIES = {"odometry": "odometry.tum", "live": "live.tum", "final": "trajectory.tum"}
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


@dataclasses.dataclass(frozen=True)
class Log:
    name: str
    source: str  # file of the data sets, or URI
    reference: str | None  # file of the data sets; None: the true path that the run itself writes
    lines_ahead: int = 0  # by which the poses in its scans precede the ranges

    def files(self):
        """Of the data sets."""
        return [] if self.reference is None else sorted({self.source, self.reference})

    def missing(self):
        """Those that do not exist."""
        return [file for file in self.files() if not (DATASETS / file).exists()]

    def stand(self):
        """Changes if its files change."""
        stats = [(DATASETS / file).stat() for file in self.files() if (DATASETS / file).exists()]
        return " ".join(f"{stat.st_size} {stat.st_mtime_ns}" for stat in stats)


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


def configuration(settings):
    """TOML."""
    return "".join(f"[{section}]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items())
                   for section, keys in settings.items())


def judge(swiftlet, trajectory, reference):
    """The JSON figures of `swiftlet eval`; None where the run wrote no such trajectory."""
    if not trajectory.exists():
        return None
    said = page.run(str(swiftlet), "eval", str(trajectory), str(reference), "--json", "-")
    [figures] = json.loads(said)["references"]
    return figures


def changed_copy(run, target):
    """Writes it. Returns a function that transforms a trajectory mapped from it back to that of the log, in place.
    Raises OSError, EOFError or ValueError where the log cannot be read."""
    recording = changed_log.read(DATASETS / run.log.source, run.log.lines_ahead)
    changed_log.write(recording, run.change, target)

    def lead_back(trajectory):
        changed_log.lead_back(trajectory, recording, run.change, trajectory)

    return lead_back


def execute(run, swiftlet):
    """Maps and evaluates. Raises OSError, EOFError, ValueError or subprocess.CalledProcessError."""
    with tempfile.TemporaryDirectory() as name:
        output = Path(name, "out")
        config = Path(name, "settings.toml")
        config.write_text(configuration(run.settings()), encoding="utf-8")
        source = run.log.source if run.log.reference is None else str(DATASETS / run.log.source)
        if run.change is not None:
            source = str(Path(name, "changed.clf"))
            lead_back = changed_copy(run, source)
        beams = [] if run.beams is None else ["--beams", str(run.beams)]
        report = whole_runs.run(swiftlet, [source, *beams, "--config", str(config)], output)
        if run.change is not None:
            for trajectory in output.glob("*.tum"):
                lead_back(trajectory)
        reference = output / "ground_truth.tum" if run.log.reference is None else DATASETS / run.log.reference
        judged = {which: judge(swiftlet, output / file, reference) for which, file in TRAJECTORIES.items()}
    return {"report": report, **judged}


class Results:
    """The results of the runs of one build of the program, one file for each."""

    def __init__(self, folder, swiftlet):
        self.folder = folder
        self.swiftlet = swiftlet
        self.program = hashlib.sha256(Path(swiftlet).read_bytes()).hexdigest()[:12]

    def file(self, run):
        """Its name depends on everything that decides the result: the program, the run, its data and, for a changed
        log, the code that changes it."""
        changer = "" if run.change is None else Path(changed_log.__file__).read_text(encoding="utf-8")
        made_of = "\n".join([self.program, repr(run), run.log.stand(), changer])
        name = re.sub("[^A-Za-z0-9]+", "-", run.title())
        return self.folder / f"{name}_{hashlib.sha256(made_of.encode()).hexdigest()[:12]}.json"

    def get(self, run):
        """None where there is no result."""
        try:
            return json.loads(self.file(run).read_text(encoding="utf-8"))
        except FileNotFoundError:
            return None

    def make(self, run, at_once):
        """`at_once`: how many runs share the machine. Raises as execute() does."""
        result = {"run": run.title(), "program": self.program, "at_once": at_once, **execute(run, self.swiftlet)}
        self.folder.mkdir(parents=True, exist_ok=True)
        begun = self.file(run).with_suffix(".part")
        begun.write_text(json.dumps(result, indent=1), encoding="utf-8")
        begun.replace(self.file(run))  # whole or not at all, however this ends

# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The ensembles of `tools/benchmark-robustness`: each log and flight many times, changed otherwise in each run. They
are drawn once, by a fixed seed, and so the same for each build."""

import dataclasses
import random
import signal
import subprocess
import tempfile
from pathlib import Path

import accuracy_runs
import benchmark_page as page
import mapped_runs
import whole_runs
from changed_log import Change
from mapped_runs import Log

SEED = 1
FEW_BEAMS, MANY_BEAMS = [4, 5, 6], [9, 10, 11, 12, 13]
DENSE_BEAMS = 61  # one in so many of the many:
DENSE_EVERY = 6
FEW, MANY = ", 4 to 6 beams", ", 9 beams and more"
STOPPED = [-signal.SIGINT, -signal.SIGTERM, -signal.SIGKILL]  # exit codes of a run that was ended from outside
LEAD_MAX_S = 0.02
PLAIN_BEAMS = [4, 11, DENSE_BEAMS]
CUT_MAX = 0.3  # of the start
PIECES = 6  # of each log and flight
PIECE_OF_LOG, PIECE_OF_FLIGHT = (0.05, 0.35), (0.3, 0.7)  # shares of it
KIND = "kind of building: "  # a note of the report
ROBOT_LOG = page.BUILD / "tests/benchmarks/robot_log"

PLAIN = [Change("as recorded")]
MIRRORED = [Change("mirrored", mirrored=True)]
BACKWARDS = [Change("backwards", backwards=True), Change("backwards, mirrored", backwards=True, mirrored=True)]
NOISE = [Change("noise 0.5", noise=0.5), Change("noise 1", noise=1.0)]
WHEELS = [Change("turns 4 % long", turns=1.04), Change("turns 4 % short", turns=0.96),
          Change("metres 3 % long", metres=1.03), Change("drift 0.5 deg/m left", drift_deg_per_m=0.5),
          Change("drift 0.5 deg/m right", drift_deg_per_m=-0.5), Change("random turns of 6 deg", random_turns_deg=6.0)]
SMALL_ERRORS = [Change("noise 0.5", noise=0.5), Change("turns 1 % long", turns=1.01),
                Change("metres 3 % short", metres=0.97)]
LOOPS = 3 * PLAIN + MIRRORED + BACKWARDS + 2 * NOISE + WHEELS  # how often each is drawn
NO_LOOPS = 3 * PLAIN + MIRRORED + BACKWARDS + SMALL_ERRORS  # larger errors could not be corrected there
FLIGHT = 2 * PLAIN + MIRRORED + NOISE + SMALL_ERRORS
SHORT_FLIGHT = 2 * PLAIN + MIRRORED + SMALL_ERRORS


@dataclasses.dataclass(frozen=True)
class Ensemble:
    log: Log
    changes: list
    runs: int
    screened: int  # runs of the screening ensemble
    window: tuple[float, float] = (0.0, 1.0)  # shares of the log that the screening ensemble takes
    is_laser: bool = True
    is_true: bool = True  # the reference; else it is an estimate of another program


def laser(name, file, reference, *rest, **choices):
    return Ensemble(Log(name, file, file if reference is None else reference), *rest, **choices)


def flight(log, *rest, **choices):
    return Ensemble(log, *rest, **choices, is_laser=False)


def vicon(name):
    return flight(Log(f"Vicon {name}", f"vicon/{name}.pcap", f"vicon/{name}_vicon.tum"), SHORT_FLIGHT, 10, 1)


ENSEMBLES = [
    Ensemble(accuracy_runs.ACES, LOOPS, 36, 4),
    Ensemble(accuracy_runs.INTEL, LOOPS, 36, 4, (0.0, 0.3)),
    Ensemble(accuracy_runs.KILLIAN, LOOPS, 36, 4, (0.0, 0.25)),
    laser("FR079", "radish/fr079.clf.gz", "radish/fr079.relations", LOOPS, 36, 4, (0.0, 0.4)),
    laser("FR clinic", "radish/fr-clinic.clf.gz", "radish/fr-clinic.relations", NO_LOOPS, 36, 4, (0.0, 0.4)),
    flight(accuracy_runs.OLSSON, FLIGHT, 24, 4, (0.3, 1.0)),
    flight(accuracy_runs.RICE, FLIGHT, 24, 4),
    *(vicon(name) for name in ("exp1_two_d0", "exp1_two_d1", "exp1_four_d0", "exp1_four_d1", "exp1_four_d2",
                               "exp1_four_d3", "exp3_two_d0", "exp3_two_d1", "icp_d0", "icp_d1")),
    laser("Robot 4", "more/robot4.clf.gz", "more/robot4_camera.tum", NO_LOOPS, 16, 2),
    laser("Duke loop", "more/loop5.clf.gz", None, NO_LOOPS, 16, 2),
    laser("Malaga", "more/sena.clf.gz", None, NO_LOOPS, 16, 2),
    *(laser(f"Mines {n}", f"more/tinyslam_exp{n}.clf.gz", None, NO_LOOPS, 10, 2) for n in range(1, 5)),
    laser("FHW", "more/kf_fhw.clf.gz", "more/kf_fhw_gfs.tum", NO_LOOPS, 20, 3, is_true=False),
    laser("Acapulco", "more/kf_acapulco.clf.gz", "more/kf_acapulco_gfs.tum", NO_LOOPS, 20, 3, is_true=False),
]
WITHOUT_TRUTH = {ensemble.log.name for ensemble in ENSEMBLES if not ensemble.is_true}
IN_CELLS = {ensemble.log.name for ensemble in ENSEMBLES if ensemble.log.reference == ensemble.log.source}


def has_truth(log):
    return log.name not in WITHOUT_TRUTH | IN_CELLS


def is_captured(log):
    """By cameras."""
    return log.name.startswith("Vicon")


def true_poses(log):
    """How many its reference has, a TUM file. Raises OSError."""
    lines = (mapped_runs.DATASETS / log.reference).read_text(encoding="utf-8").splitlines()
    return sum(bool(line.strip()) and not line.startswith("#") for line in lines)


@dataclasses.dataclass(frozen=True)
class Run:
    log: Log
    beams: int | None
    change: Change | None
    settings: str = ""  # TOML

    def configuration(self):
        return self.settings

    def title(self):
        words = [self.log.name, *([] if self.beams is None else [f"{self.beams} beams"])]
        if self.change is None:
            return ", ".join(words)
        words.append(self.change.name + (f", seed {self.change.seed}" if self.change.seed else ""))
        words.append(f"{self.change.lead_s * 1e3:+.0f} ms")
        if (self.change.first, self.change.last) != (0.0, 1.0):
            words.append(f"{self.change.first:.0%} to {self.change.last:.0%}")
        return ", ".join(words)

    def group(self):
        """Runs that are compared: those of one log with like numbers of beams."""
        return self.log.name + ("" if self.beams is None else FEW if self.beams <= max(FEW_BEAMS) else MANY)


def shuffled_rounds(values, count, chance):
    """So many of the values, each as often as the others."""
    drawn = []
    while len(drawn) < count:
        drawn += chance.sample(values, len(values))
    return drawn[:count]


def beams_of(ensemble, count, chance):
    """Few and many in turn; None for flights."""
    if not ensemble.is_laser:
        return [None] * count
    few = shuffled_rounds(FEW_BEAMS, count, chance)
    many = [DENSE_BEAMS if i % DENSE_EVERY == DENSE_EVERY - 1 else beams
            for i, beams in enumerate(shuffled_rounds(MANY_BEAMS, count, chance))]
    return [beams for both in zip(few, many) for beams in both][:count]


def part_played(change, chance, window):
    """(first, last) share. `window`: that of the log, None: the start is cut by chance."""
    if window is None:
        return round(chance.choice([0.0, 1.0, 1.0]) * chance.uniform(0.0, CUT_MAX), 3), 1.0
    return (1.0 - window[1], 1.0 - window[0]) if change.backwards else window


def drawn(ensemble, count, chance, window):
    """`window`: as in part_played()."""
    runs = []
    changes = shuffled_rounds(ensemble.changes, count, chance)
    for number, (beams, change) in enumerate(zip(beams_of(ensemble, count, chance), changes), 1):
        first, last = part_played(change, chance, window)
        is_random = change.noise or change.random_turns_deg
        change = dataclasses.replace(change, first=first, last=last, seed=number if is_random else 0,
                                     lead_s=round(chance.uniform(-LEAD_MAX_S, LEAD_MAX_S), 3))
        # Played forwards, the poses lead the ranges as they do in the log.
        log = ensemble.log if change.backwards else dataclasses.replace(ensemble.log, lines_ahead=0)
        runs.append(Run(log, beams, change))
    return runs


def ensemble_runs():
    """In an order in which the first runs are a sample of all."""
    runs = [run for ensemble in ENSEMBLES
            for run in drawn(ensemble, ensemble.runs, random.Random(f"{SEED} {ensemble.log.name}"), None)]
    random.Random(SEED).shuffle(runs)
    return runs


def screen_runs():
    """Short ones."""
    return [run for ensemble in ENSEMBLES
            for run in drawn(ensemble, ensemble.screened, random.Random(f"screen {SEED} {ensemble.log.name}"),
                             ensemble.window)]


def piece_runs():
    """A piece of a log or flight, as recorded, is a short run: it meets few places again."""
    runs = []
    for ensemble in ENSEMBLES:
        chance = random.Random(f"pieces {SEED} {ensemble.log.name}")
        for number, beams in enumerate(beams_of(ensemble, PIECES, chance)):
            share = chance.uniform(*(PIECE_OF_LOG if ensemble.is_laser else PIECE_OF_FLIGHT))
            first = (1.0 - share) * (number + chance.random()) / PIECES  # evenly from start to end
            change = dataclasses.replace(*PLAIN, first=round(first, 3), last=round(first + share, 3))
            runs.append(Run(dataclasses.replace(ensemble.log, lines_ahead=0), beams, change))
    return runs


def plain_runs():
    """Each log once with each of PLAIN_BEAMS, each flight once."""
    return [Run(ensemble.log, beams, None) for ensemble in ENSEMBLES
            for beams in (PLAIN_BEAMS if ensemble.is_laser else [None])]


def building_runs(first, last):
    return [Run(Log(f"building {seed}", f"sim://building?seed={seed}", None), None, None)
            for seed in range(first, last + 1)]


def robot_runs(first, last):
    """Robots with wheels, each with one of PLAIN_BEAMS in turn. Raises OSError where ROBOT_LOG was not built."""
    made_by = mapped_runs.content_digest(ROBOT_LOG)
    return [Run(Log(f"robot {seed}", f"{ROBOT_LOG.name} {made_by}", None), PLAIN_BEAMS[seed % len(PLAIN_BEAMS)], None)
            for seed in range(first, last + 1)]


def seed_of(log):
    """Of a building or robot."""
    return log.name.split()[-1]


def logged_drive(run, folder):
    """The run with what its robot logs, and the kind of its building. Raises as page.run() does."""
    kind = page.run(str(ROBOT_LOG), seed_of(run.log), str(folder / "drive")).strip()
    log = Log(run.log.name, str(folder / "drive.clf"), str(folder / "drive.tum"))
    return dataclasses.replace(run, log=log), kind


def with_settings(run, settings):
    return dataclasses.replace(run, settings=settings)


class Results(mapped_runs.Results):
    """With the pictures of the maps and the kinds of buildings. A run that fails is a result, too, but not one that was
    ended from outside."""

    def get(self, run):
        """None also of a building whose kind was not kept."""
        result = super().get(run)
        is_kept = result is None or run.log.files() or "failed" in result or "kind" in result["report"]
        return result if is_kept else None

    modules = (whole_runs,)

    def picture(self, run):
        return self.file(run).with_suffix(".png")

    def mapped(self, run, picture):
        result = mapped_runs.execute(run, self.swiftlet, picture)
        return {**result, "report": figures_of(result["report"])}

    def judged(self, run, picture):
        try:
            return self.mapped(run, picture)
        except subprocess.CalledProcessError as error:
            if error.returncode in STOPPED:
                raise
            said = (error.stderr or "").strip().splitlines()
            return {"failed": f"exit code {error.returncode}" + (f": {said[-1]}" if said else "")}

    def executed(self, run):
        if not run.log.source.startswith(ROBOT_LOG.name):
            return self.judged(run, self.picture(run))
        with tempfile.TemporaryDirectory() as folder:
            with_log, kind = logged_drive(run, Path(folder))
            result = self.judged(with_log, self.picture(run))
        return result if "failed" in result else {**result, "report": {**result["report"], "kind": kind}}


def figures_of(report):
    """What the page needs of a run's report."""
    kinds = [note.removeprefix(KIND) for note in report["input"]["notes"] if note.startswith(KIND)]
    return {**whole_runs.figures_of(report), "closures": report["backend"]["closures"],
            "kind": kinds[0] if kinds else None}


def error_of(judged):
    """One trajectory's error, m, or its number of cells; None where there is none."""
    if judged is None:
        return None
    if "all" in judged:
        return judged["all"]["translation_m"]["mean"]
    if "rmse_m" in judged:
        return judged["rmse_m"]
    return judged["cells_20_cm"] if "cells_20_cm" in judged else judged["cells_10_cm"]


def rotation_of(judged):
    """Mean rotational error of relations, deg; None where the reference is none."""
    return judged["all"]["rotation_deg"]["mean"] if "all" in judged else None


def is_in_cells(judged):
    return "all" not in judged and "rmse_m" not in judged

# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Runs over which two builds of swiftlet are compared: the list, and the outputs of a program for one."""

import dataclasses
import hashlib
import json
import subprocess
import tempfile
from pathlib import Path

import mapped_runs
import benchmark_page as page
from accuracy_runs import ACES, INTEL, KILLIAN, OLSSON, RICE
from mapped_runs import DATASETS

DATA = "data/"  # the data sets, seen from a run; relative, so that no output names a folder of this machine
PLACES = {"swiftlet": ["tools/swiftlet", "swiftlet"], "swiftletd": ["daemon/swiftletd", "swiftletd"]}  # in a build


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    arguments: tuple[str, ...]  # of the program; outputs go to out/
    settings: dict = dataclasses.field(default_factory=dict)  # keys of the configuration, by section
    program: str = "swiftlet"
    stdout: str | None = None  # file that it is compared as; None: not compared
    not_compared: tuple[str, ...] = ()  # files that depend on timing
    is_quick: bool = False

    def files(self):
        """Of the data sets."""
        return sorted({word.removeprefix(DATA) for word in self.arguments if word.startswith(DATA)})

    def missing(self):
        return [file for file in self.files() if not (DATASETS / file).exists()]

    def key(self):
        """Depends on everything but the program that decides the outputs."""
        stats = [(DATASETS / file).stat() for file in self.files()]
        made_of = [repr(self), *(f"{stat.st_size} {stat.st_mtime_ns}" for stat in stats)]
        return hashlib.sha256("\n".join(made_of).encode()).hexdigest()[:12]


def mapped(name, source, *options, **rest):
    return Case(name, ("map", source, *options, "-o", "out"), **rest)


def flight(name, log, *options, **rest):
    return mapped(name, DATA + log.source, *options, **rest)


def by_daemon(name, source):
    """No sample is lost at any rate. Timing decides which correction a published pose has, and so its error where the
    truth is known."""
    return Case(name, ("--input", source, "--rate", "1e6", "--lcm-url", "memq://", "--no-record", "-o", "out"),
                program="swiftletd", not_compared=("live.tum",))


def calibrated(name, source, **rest):
    return Case(name, ("calibrate", source, "--json", "-o", "out/settings.toml"), stdout="calibration.json", **rest)


def judged(name, trajectory, log):
    arguments = ("eval", f"{DATA}paper_results/{trajectory}", DATA + log.reference, "--json", "out/errors.json")
    return Case(name, arguments, stdout="table.txt", is_quick=True)


# The longest first, so that the processors end together.
CASES = [
    *(flight(f"{name}-{beams}", log, "--beams", str(beams), is_quick=log is ACES)
      for name, log in (("killian", KILLIAN), ("intel", INTEL), ("aces", ACES)) for beams in (11, 4)),
    flight("intel-pruned", INTEL, settings={"backend": {"max_scans": 2000}}),
    mapped("fr079-11", f"{DATA}radish/fr079.clf.gz", "--beams", "11"),
    flight("aces-odometry-only", ACES, "--odometry-only"),
    flight("aces-frontend-only", ACES, "--frontend-only"),
    flight("aces-unrefined", ACES, settings={"backend": {"refine": False}}),
    flight("aces-unaligned", ACES, settings={"frontend": {"align_to_walls": False},
                                             "backend": {"align_to_walls": False}}),
    flight("aces-calibrated", ACES, settings={"sensor": {
        "odometry_forward_scale": 1.01, "odometry_sideways_scale": 0.99, "missed_yaw_per_metre_rad": 0.01,
        "missed_yaw_per_radian": -0.01, "missed_yaw_per_second_rad": 0.001, "range_age_s": 0.05}}),
    mapped("sim-patrol-pruned", "sim://patrol?seed=1&laps=12", settings={"backend": {"max_scans": 1000}}),
    flight("olsson", OLSSON, is_quick=True),
    flight("rice", RICE, is_quick=True),
    *(mapped(f"sim-{world}", f"sim://{world}?seed=1", is_quick=world in ("office", "maze"))
      for world in ("office", "maze", "loop", "corridors", "wings", "patrol")),
    *(mapped(f"vicon-{name}", f"{DATA}vicon/{name}.pcap") for name in ("exp1_four_d0", "icp_d0")),
    by_daemon("daemon-rice", DATA + RICE.source),
    by_daemon("daemon-aces", DATA + ACES.source),
    calibrated("calibrate-rice", DATA + RICE.source),
    calibrated("calibrate-sim-office", "sim://office?seed=1", is_quick=True),
    Case("record-sim-office", ("record", "sim://office?seed=1", "--seconds", "60", "-o", "out/flight.pcap")),
    judged("eval-aces", "aces_11.tum", ACES),
    judged("eval-olsson", "olsson.tum", OLSSON),
]


def execute(case, program, folder):
    """Runs it in `folder`. Its files are in out/ then, exit code and last line of stderr in outcome.json. Raises
    OSError."""
    (folder / "out").mkdir(parents=True)
    (folder / "data").symlink_to(DATASETS.resolve())
    settings = []
    if case.settings:
        (folder / "settings.toml").write_text(mapped_runs.configuration(case.settings), encoding="utf-8")
        settings = ["--config", "settings.toml"]
    done = subprocess.run([str(program), *case.arguments, *settings], cwd=folder, capture_output=True, check=False)
    if case.stdout is not None:
        (folder / "out" / case.stdout).write_bytes(done.stdout)
    for name in case.not_compared:
        (folder / "out" / name).unlink(missing_ok=True)
    lines = done.stderr.decode(errors="replace").strip().splitlines()
    outcome = {"exit_code": done.returncode, "stderr": lines[-1] if lines else ""}
    (folder / "outcome.json").write_text(json.dumps(outcome), encoding="utf-8")


def kept(case, program, folder):
    """The folder below `folder` with this program's outputs, made now or earlier. Raises OSError."""
    digest = hashlib.sha256(program.read_bytes()).hexdigest()[:12]
    target = folder / digest / f"{case.name}_{case.key()}"
    if not target.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=target.parent) as begun:
            execute(case, program, Path(begun, "run"))
            try:
                Path(begun, "run").rename(target)  # whole or not at all, however this ends
            except OSError:
                if not target.exists():  # another comparison was faster
                    raise
    return target


class Programs:
    """The programs of one build."""

    def __init__(self, swiftlet):
        """Raises FileNotFoundError."""
        self.swiftlet = swiftlet.resolve(strict=True)

    def get(self, name):
        """None where the build lacks it."""
        if name == "swiftlet":
            return self.swiftlet
        beside = [folder / place for folder in self.swiftlet.parents[:2] for place in PLACES[name]]
        return next((path for path in beside if path.is_file()), None)


def built(commit, folder):
    """swiftlet of a commit, checked out and built below `folder` if it is not there. Raises OSError or
    subprocess.CalledProcessError."""
    checkout = folder / commit
    if not checkout.exists():
        page.run("git", "worktree", "add", "--quiet", "--force", "--detach", str(checkout), commit)
    page.run("cmake", "-S", str(checkout), "--preset", "release")
    page.run("cmake", "--build", str(checkout / "build/release"), "--target", "swiftlet", "swiftletd")
    return checkout / "build/release/tools/swiftlet"

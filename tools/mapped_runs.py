# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Runs of `swiftlet map` evaluated by `swiftlet eval`, and their results, kept for each build."""

import concurrent.futures
import dataclasses
import functools
import hashlib
import json
import os
import re
import shutil
import sys
import tempfile
import threading
from pathlib import Path

import benchmark_page as page
import changed_capture
import changed_log
import log_sharpness
import whole_runs

DATASETS = Path(os.environ.get("SWIFTLET_DATASETS", page.ROOT.parent / "shared/datasets"))
TRAJECTORIES = {"odometry": "odometry.tum", "live": "live.tum", "final": "trajectory.tum"}
BAR_WIDTH = 30


@functools.cache
def content_digest(file):
    """Of its content; once a process."""
    return hashlib.sha256(file.read_bytes()).hexdigest()


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
        """Changes if its files change; copies of them are the same."""
        return " ".join(content_digest(DATASETS / file) for file in self.files() if (DATASETS / file).exists())


def configuration(settings):
    """TOML."""
    return "".join(f"[{section}]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items())
                   for section, keys in settings.items())


def available(name, runs):
    """Those whose data exist; names what is missing on stderr. `name`: of the program. Raises LookupError if there are
    none."""
    for file in sorted({file for run in runs for file in run.log.missing()}):
        print(f"{name}: left out, missing: {DATASETS / file}", file=sys.stderr)
    there = [run for run in runs if not run.log.missing()]
    if not there:
        raise LookupError("no run: no such log, or its data are missing; set SWIFTLET_DATASETS to their folder")
    return there


def kept_program(swiftlet, folder):
    """A copy, named by the hash of its content: a new build does not disturb these runs. `swiftlet`: its path, or the
    name of an earlier copy. Raises OSError."""
    if not swiftlet.exists() and (folder / swiftlet.name).exists():
        return folder / swiftlet.name
    content = swiftlet.read_bytes()
    kept = folder / hashlib.sha256(content).hexdigest()[:12]
    if not kept.exists():
        folder.mkdir(parents=True, exist_ok=True)
        begun = kept.with_suffix(f".{os.getpid()}")
        begun.write_bytes(content)
        begun.chmod(0o755)
        begun.replace(kept)
    return kept


def is_laser_log(file):
    return str(file).endswith((".clf", ".clf.gz"))


def judge(swiftlet, trajectory, reference):
    """The JSON figures of `swiftlet eval`, or those of log_sharpness where the reference is the laser log itself; None
    where the run wrote no such trajectory."""
    if not trajectory.exists():
        return None
    if is_laser_log(reference):
        return log_sharpness.evaluate(trajectory, reference)
    said = page.run(str(swiftlet), "eval", str(trajectory), str(reference), "--json", "-")
    [figures] = json.loads(said)["references"]
    return figures


def changed_copy(run, folder):
    """Writes it. Returns its path, and a function that transforms a trajectory mapped from it back to that of the log,
    in place. Raises OSError, EOFError or ValueError where the log cannot be read or changed so."""
    source = DATASETS / run.log.source
    if source.suffix == ".pcap":
        target = folder / "changed.pcap"
        changed_capture.write(source, run.change, target)
        return target, lambda trajectory: changed_capture.lead_back(trajectory, run.change, trajectory)
    target = folder / "changed.clf"
    recording = changed_log.read(source, run.log.lines_ahead)
    changed_log.write(recording, run.change, target)
    ends = [(stamp, []) for stamp, _ in (recording.scans[0], recording.scans[-1])]
    timing = dataclasses.replace(recording, poses=[], scans=ends)  # what lead_back() needs, of all the readings
    return target, lambda trajectory: changed_log.lead_back(trajectory, timing, run.change, trajectory)


class Copies:
    """Makes changed copies as changed_copy() does, each once, and keeps them in a folder."""

    def __init__(self, folder):
        self.folder = folder
        self.lock = threading.Lock()
        self.made = {}  # (log, change): Future

    def __call__(self, run, _folder):
        key = run.log, run.change
        with self.lock:
            is_first = key not in self.made
            made = self.made.setdefault(key, concurrent.futures.Future())
            if is_first:
                folder = self.folder / str(len(self.made))
        if is_first:
            try:
                folder.mkdir()
                made.set_result(changed_copy(run, folder))
            except BaseException as error:
                made.set_exception(error)
        return made.result()


def digest_of(folder):
    """Of all files of a run, but for the report: it has times."""
    files = sorted(file for file in folder.rglob("*") if file.is_file() and file.name != "report.json")
    content = hashlib.sha256()
    for file in files:
        content.update(f"{file.relative_to(folder)} {file.stat().st_size}\n".encode())
        content.update(file.read_bytes())
    return content.hexdigest()


def execute(run, swiftlet, picture=None, copied=changed_copy, known=lambda digest: None, which=tuple(TRAJECTORIES)):
    """Maps and evaluates. `picture`: where the map's is kept. `copied`: changed_copy() or Copies. `known`: what output
    with this digest was judged, or None. `which`: trajectories to judge. Raises OSError, EOFError, ValueError or
    subprocess.CalledProcessError."""
    with tempfile.TemporaryDirectory() as name:
        output = Path(name, "out")
        config = Path(name, "settings.toml")
        config.write_text(run.configuration(), encoding="utf-8")
        source = run.log.source if run.log.reference is None else DATASETS / run.log.source
        if run.change is not None:
            source, lead_back = copied(run, Path(name))
        beams = [] if run.beams is None else ["--beams", str(run.beams)]
        report = whole_runs.run(swiftlet, [str(source), *beams, "--config", str(config)], output)
        digest = digest_of(output)
        if (judged := known(digest)) is not None:
            return {"report": report, "digest": digest, **judged}
        if run.change is not None:
            for trajectory in output.glob("*.tum"):
                lead_back(trajectory)
        reference = output / "ground_truth.tum" if run.log.reference is None else DATASETS / run.log.reference
        judged = {name: judge(swiftlet, output / TRAJECTORIES[name], reference) for name in which}
        if picture is not None:
            picture.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(output / "map.png", picture)
    return {"report": report, "digest": digest, **judged}


def modules_of(run):
    """Those of ours that change its log, and that judge it where the program does not."""
    changing = [] if run.change is None else [changed_log, changed_capture]
    judging = [changed_log, log_sharpness] if is_laser_log(run.log.reference) else []
    return list(dict.fromkeys(changing + judging))


class Results:
    """The results of the runs of one build of the program, one file for each."""

    modules = ()  # of ours, besides modules_of(), that make the figures which executed() returns

    def __init__(self, folder, swiftlet):
        self.folder = folder
        self.swiftlet = swiftlet
        self.program = hashlib.sha256(Path(swiftlet).read_bytes()).hexdigest()[:12]

    def file(self, run):
        """Its name depends on everything that decides the result: the program, the run, its data and the code of ours
        that has a part in it."""
        modules = [*modules_of(run), *self.modules]
        code = "".join(Path(module.__file__).read_text(encoding="utf-8") for module in modules)
        made_of = "\n".join([self.program, repr(run), run.log.stand(), code])
        name = re.sub("[^A-Za-z0-9]+", "-", run.title())
        return self.folder / f"{name}_{hashlib.sha256(made_of.encode()).hexdigest()[:12]}.json"

    def get(self, run):
        """None where there is no result."""
        try:
            return json.loads(self.file(run).read_text(encoding="utf-8"))
        except FileNotFoundError:
            return None

    def executed(self, run):
        """Raises as execute() does."""
        return execute(run, self.swiftlet)

    def make(self, run, at_once):
        """`at_once`: how many runs share the machine. Raises as executed() does."""
        result = {"run": run.title(), "program": self.program, "at_once": at_once, **self.executed(run)}
        self.folder.mkdir(parents=True, exist_ok=True)
        begun = self.file(run).with_suffix(".part")
        begun.write_text(json.dumps(result, indent=1), encoding="utf-8")
        begun.replace(self.file(run))  # whole or not at all, however this ends


def show_progress(name, done, total, what):
    if sys.stderr.isatty():
        full = BAR_WIDTH * done // total
        end = "\n" if done == total else ""
        print(f"\r\x1b[K[{'#' * full}{'.' * (BAR_WIDTH - full)}] {done} of {total}: {what}", end=end, file=sys.stderr,
              flush=True)
    else:
        print(f"{name}: {done} of {total}: {what}", file=sys.stderr, flush=True)


def make_missing(name, runs, results, jobs):
    """`name`: of the program. Raises as Results.make() does; the results so far are kept."""
    to_make = [run for run in runs if results.get(run) is None]
    if to_make:
        show_progress(name, len(runs) - len(to_make), len(runs), "exist already")
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        begun = {pool.submit(results.make, run, jobs): run for run in to_make}
        try:
            for done, future in enumerate(concurrent.futures.as_completed(begun), len(runs) - len(to_make) + 1):
                future.result()
                show_progress(name, done, len(runs), begun[future].title())
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise

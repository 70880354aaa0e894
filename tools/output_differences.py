# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""Differences between the outputs of two runs of one input: text by the first line, trajectories in metres, JSON by its
keys."""

import itertools
import json
import math

TEXT = {".toml", ".tum", ".txt", ".yaml"}
OF_THE_MACHINE = {"stage_times", "histograms_ns", "queues", "pose_deadline", "run_peak_memory_mb", "peak_memory_mb"}
MAX_KEYS = 5


def flat(data, path=()):
    """The leaves of a JSON document by their paths, without those that depend on the machine."""
    if not isinstance(data, dict | list) or not data:
        return {path: data}
    items = data.items() if isinstance(data, dict) else enumerate(data)
    leaves = {}
    for key, value in items:
        if key not in OF_THE_MACHINE:
            leaves |= flat(value, (*path, str(key)))
    return leaves


def renamed(path, renames):
    """`renames`: pairs of names; a plain one stands for that key anywhere, a dotted one for a path."""
    for old, new in renames:
        old, new = tuple(old.split(".")), tuple(new.split("."))
        if len(old) == 1:
            path = tuple(itertools.chain.from_iterable(new if key == old[0] else [key] for key in path))
        elif path[: len(old)] == old:
            path = new + path[len(old):]
    return path


def renamed_settings(settings, renames):
    """The settings of a configuration, by section."""
    result = {}
    for section, keys in settings.items():
        for key, value in keys.items():
            new_section, new_key = renamed((section, key), renames)
            result.setdefault(new_section, {})[new_key] = value
    return result


def data_difference(old, new, renames):
    old = {renamed(path, renames): value for path, value in flat(json.loads(old)).items()}
    new = flat(json.loads(new))
    nothing = object()

    def text(value):
        return "none" if value is nothing else json.dumps(value)

    differing = [(path, old.get(path, nothing), new.get(path, nothing)) for path in dict.fromkeys([*old, *new])]
    lines = [f"{'.'.join(path)} {text(a)} -> {text(b)}" for path, a, b in differing if a != b]
    more = [f"{len(lines) - MAX_KEYS} keys more"] if len(lines) > MAX_KEYS else []
    return ", ".join(lines[:MAX_KEYS] + more)


def positions(lines):
    """Positions of a TUM file by the texts of their stamps."""
    rows = [line.split() for line in lines if line.strip() and not line.startswith("#")]
    return {row[0]: (float(row[1]), float(row[2])) for row in rows}


def distance(old, new):
    old, new = positions(old), positions(new)
    both = old.keys() & new.keys()
    apart = f"at most {max(math.dist(old[stamp], new[stamp]) for stamp in both):.3g} m" if both else "no common stamp"
    alone = len(old.keys() ^ new.keys())
    return apart + (f", {alone} stamps in one of them only" if alone else "")


def text_difference(old, new, is_trajectory):
    old, new = old.decode(errors="replace").splitlines(), new.decode(errors="replace").splitlines()
    pairs = enumerate(itertools.zip_longest(old, new, fillvalue="(end)"), 1)
    number, a, b = next(((i, a, b) for i, (a, b) in pairs if a != b), (0, "", ""))
    first = f'line {number}: "{a}" -> "{b}"' if number else "line ends"
    return f"{distance(old, new)}, {first}" if is_trajectory else first


def byte_difference(old, new):
    number = sum(a != b for a, b in zip(old, new))
    length = "" if len(old) == len(new) else f", length {len(old)} -> {len(new)}"
    return f"{number} of {min(len(old), len(new))} bytes{length}"


def difference(name, old, new, renames=()):
    """The difference of two contents of the file `name`, in one line; empty if they are equal. Raises ValueError if
    they are not of the kind of its name."""
    if old == new:
        return ""
    suffix = name[name.rfind("."):]
    if suffix == ".json":
        return data_difference(old, new, renames)
    return text_difference(old, new, suffix == ".tum") if suffix in TEXT else byte_difference(old, new)


def files(folder):
    return {path.relative_to(folder).as_posix(): path for path in folder.rglob("*") if path.is_file()}


def exit_difference(old, new):
    if old["exit_code"] == new["exit_code"]:
        return []
    said = new["stderr"] if new["exit_code"] else old["stderr"]
    return [f"exit code {old['exit_code']} -> {new['exit_code']} ({said})"]


def differences(old, new, renames=()):
    """One text for each difference between the folders of two runs."""
    outcomes = [json.loads((run / "outcome.json").read_text(encoding="utf-8")) for run in (old, new)]
    found = exit_difference(*outcomes)
    old, new = files(old / "out"), files(new / "out")
    for which, names in (("OLD", old.keys() - new.keys()), ("NEW", new.keys() - old.keys())):
        found += [f"only {which} writes {', '.join(sorted(names))}"] if names else []
    for name in sorted(old.keys() & new.keys()):
        try:
            what = difference(name, old[name].read_bytes(), new[name].read_bytes(), renames)
        except ValueError as error:
            what = f"unreadable: {error}"
        found += [f"{name}: {what}"] if what else []
    return found

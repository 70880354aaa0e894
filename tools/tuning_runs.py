# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The runs of `tools/benchmark-tuning`: the constants of core, each halved and doubled, over a screening ensemble of
simulated buildings and short real runs."""

import dataclasses
import math
import re
import subprocess

import mapped_runs
import robustness_runs
import whole_runs

REAL_RUNS_OF_A_LOG = 1  # of those of `benchmark-robustness --screen`, of laser logs with few beams
LINE = re.compile(r"(\w+) = (\S+)  # (\S+) to (\S+)")
STRUCT = re.compile(r"^struct \w+ \{\n(.*?)^\};", re.MULTILINE | re.DOTALL)
MEMBER = re.compile(r"^ +(?:double|int|std::size_t) (\w+)\s*=[^;]*;[ ]*(?:///< (.*(?:\n +///< .*)*))?", re.MULTILINE)
NAMED = re.compile(r'\{"(\w+)",\s*&\w+::\w+\}')


@dataclasses.dataclass(frozen=True)
class Constant:
    part: str
    key: str
    text: str  # the value, as TOML has it
    lowest: float
    highest: float
    origin: str = ""  # the comment in the source

    def name(self):
        return f"{self.part}.{self.key}"

    def is_count(self):
        return re.fullmatch(r"\d+", self.text) is not None

    def times(self, factor):
        """The value changed, within its range, as TOML has it; None where it stays as it is."""
        value = min(max(float(self.text) * factor, self.lowest), self.highest)
        text = str(math.floor(value + 0.5)) if self.is_count() else repr(value)
        return None if float(text) == float(self.text) else text

    def setting(self, text):
        """TOML."""
        return f"[tuning.{self.part}]\n{self.key} = {text}\n"


@dataclasses.dataclass(frozen=True)
class Variant:
    constant: Constant
    factor: float
    text: str  # the value

    def settings(self):
        return self.constant.setting(self.text)


def constants_of(printed, origins):
    """All that `swiftletd --print-tuning` printed. `origins`: origins_of(). Raises ValueError where it cannot be
    read."""
    parts = []
    for line in printed.splitlines():
        if line.startswith("[tuning.") and line.endswith("]"):
            parts.append((line.removeprefix("[tuning.").removesuffix("]"), []))
        elif found := LINE.fullmatch(line):
            parts[-1][1].append(found.groups())
        else:
            raise ValueError(f"--print-tuning: {line!r} is no constant with its range")
    constants = []
    for part, rows in parts:
        comments = origins.get(tuple(key for key, *_ in rows), {})
        constants += [Constant(part, key, text, float(lowest), float(highest), comments.get(key, ""))
                      for key, text, lowest, highest in rows]
    return constants


def origins_of(source):
    """{keys of a struct, in order: {key: its comment}} of the text of a header."""
    found = {}
    for body in STRUCT.findall(source):
        if "TuningValue<" not in body:
            continue
        comments = {key: re.sub(r"\s*\n\s*///<\s*", " ", comment) for key, comment in MEMBER.findall(body)}
        keys = tuple(NAMED.findall(body))
        found[keys] = {key: comments.get(key, "") for key in keys}
    return found


def all_origins(folder):
    """Of all headers below a folder. Raises OSError."""
    found = {}
    for header in sorted(folder.rglob("*.hpp")):
        found.update(origins_of(header.read_text(encoding="utf-8")))
    return found


def printed_by(swiftletd):
    """Raises OSError or subprocess.CalledProcessError."""
    return subprocess.run([str(swiftletd), "--print-tuning"], check=True, capture_output=True, text=True).stdout


def variants_of(constants):
    return [Variant(constant, factor, text) for constant in constants for factor in (0.5, 2.0)
            if (text := constant.times(factor)) is not None]


def screening_ensemble(buildings):
    """The first so many buildings, and real runs."""
    seen = {}
    real = []
    for run in robustness_runs.screen_runs():
        seen[run.log.name] = seen.get(run.log.name, 0) + 1
        if seen[run.log.name] <= REAL_RUNS_OF_A_LOG:
            real.append(run)
    return (robustness_runs.building_runs(0, buildings - 1) if buildings else []) + real


def varied(runs, variant):
    """The runs with a constant changed. No variant: as they are."""
    return [robustness_runs.with_settings(run, variant.settings() if variant else "") for run in runs]


class Results(robustness_runs.Results):
    """Keeps no pictures, nor kinds of buildings. What cannot differ from the run with the default settings is not judged again: dead reckoning,
    and output that is the same."""

    def __init__(self, folder, swiftlet, copies):
        super().__init__(folder, swiftlet)
        self.copies = mapped_runs.Copies(copies)

    get = mapped_runs.Results.get

    def mapped(self, run, _picture):
        default = (self.get(robustness_runs.with_settings(run, "")) or {}) if run.settings else {}
        judged = {name: default[name] for name in ("odometry", "final") if name in default}
        result = mapped_runs.execute(run, self.swiftlet, copied=self.copies,
                                     known=lambda digest: judged if digest == default.get("digest") else None,
                                     which=("final",) if "odometry" in judged else ("odometry", "final"))
        return {**judged, **result, "report": whole_runs.figures_of(result["report"])}

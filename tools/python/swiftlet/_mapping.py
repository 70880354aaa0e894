# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""swiftlet.map() and what it returns."""

from __future__ import annotations

import json
import numbers
import os
import re
import warnings
from dataclasses import dataclass
from typing import Any, Callable, Iterator, Mapping, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _native

_FREE_BELOW_PERCENT = 45
_OCCUPIED_FROM_PERCENT = 65


class DamagedInputWarning(UserWarning):
    """The input was damaged; the run holds what came before the damage, or lies around it."""


@dataclass(frozen=True, eq=False, repr=False)
class Grid:
    """An occupancy map. Row 0 is at the lowest y, column 0 at the lowest x of frame map."""

    occupancy_percent: npt.NDArray[np.int8]
    """Rows x columns: 0 to 100, -1 where nothing is known."""
    resolution_m: float
    """Side of a cell."""
    origin_m: Tuple[float, float]
    """x and y, in frame map, of the outer corner of cell [0, 0]."""

    @property
    def probability(self) -> npt.NDArray[np.float32]:
        """Rows x columns: of being occupied, 0 to 1; NaN where nothing is known. A new array."""
        probability = self.occupancy_percent.astype(np.float32) / np.float32(100)
        probability[self.occupancy_percent < 0] = np.nan
        return probability

    @property
    def free(self) -> npt.NDArray[np.bool_]:
        """Rows x columns: what map.pgm shows as free."""
        return (self.occupancy_percent >= 0) & (self.occupancy_percent < _FREE_BELOW_PERCENT)

    @property
    def occupied(self) -> npt.NDArray[np.bool_]:
        """Rows x columns: what map.pgm shows as occupied."""
        return self.occupancy_percent >= _OCCUPIED_FROM_PERCENT

    @property
    def extent_m(self) -> Tuple[float, float, float, float]:
        """Lowest and highest x, lowest and highest y: `extent` of matplotlib's imshow() with origin="lower"."""
        rows, columns = self.occupancy_percent.shape
        x_m, y_m = self.origin_m
        return x_m, x_m + columns * self.resolution_m, y_m, y_m + rows * self.resolution_m

    def cell(self, x_m: float, y_m: float) -> Tuple[int, int]:
        """Row and column of the cell that holds a point of frame map. They lie outside the array where it does."""
        return (int(np.floor((y_m - self.origin_m[1]) / self.resolution_m)),
                int(np.floor((x_m - self.origin_m[0]) / self.resolution_m)))

    def __repr__(self) -> str:
        rows, columns = self.occupancy_percent.shape
        return f"<swiftlet.Grid {rows} x {columns} cells of {self.resolution_m:g} m>"


@dataclass(frozen=True, eq=False, repr=False)
class Run:
    """A mapped input. Poses are rows of time (s since 1970), x, y (m) and yaw (rad, counter-clockwise). The arrays of
    N rows have one for each sample, in the same order."""

    input: str
    """As it was given."""
    trajectory: npt.NDArray[np.float64]
    """N x 4: the corrected path, in frame map."""
    live: npt.NDArray[np.float64]
    """N x 4: the poses as swiftletd would have published them on the way, in frame map."""
    odometry: npt.NDArray[np.float64]
    """N x 4: the vehicle's own dead reckoning, in frame odom."""
    truth: npt.NDArray[np.float64]
    """M x 4: the true path in frame world, of a simulated input; of others 0 x 4."""
    covariances: npt.NDArray[np.float64]
    """N x 3 x 3: of (x, y, yaw) of `live`, relative to the start of the run, along the axes of frame map. The poses of
    `trajectory` know all that came later, and are better."""
    covariances_map: npt.NDArray[np.float64]
    """N x 3 x 3: the same, relative to the part of the map around the vehicle."""
    trajectory_storeys: npt.NDArray[np.int8]
    """N: the storey of the building where each sample was taken, a number as in `storeys`."""
    walls: npt.NDArray[np.float64]
    """K x 4: x and y of the start, x and y of the end of each wall, in frame map; storey by storey."""
    wall_storeys: npt.NDArray[np.int8]
    """K: of each wall."""
    closures: npt.NDArray[np.float64]
    """K x 4: loop closures, from where to where in frame map; storey by storey."""
    closure_storeys: npt.NDArray[np.int8]
    """K: of each closure."""
    dropped_closures: npt.NDArray[np.float64]
    """K x 4: those that were dropped, on the way or in the final pass; storey by storey."""
    dropped_closure_storeys: npt.NDArray[np.int8]
    """K: of each of these."""
    grid: Grid
    """The map, of a building with several storeys the first one's."""
    storeys: Mapping[int, Grid]
    """The map of each storey, by its number: 0 is `grid`."""
    report: Mapping[str, Any]
    """What report.json holds: counts, times, errors where the truth is known (docs/outputs.md)."""
    notes: Tuple[str, ...]
    """Remarks, a line each."""
    problems: Tuple[str, ...]
    """What was wrong with the input, a line each; empty for a sound one."""

    def __repr__(self) -> str:
        return (f"<swiftlet.Run of {self.input}: {len(self.trajectory)} poses, {len(self.closures)} loop closures, "
                f"{self.grid!r}>")


def _name_of_file(option: str, name: Union[str, os.PathLike[str]]) -> bytes:
    """In the system's own bytes, which need be no text."""
    try:
        return os.fsencode(name)
    except UnicodeEncodeError:
        raise _native.Error(f"{option} = {name!r}: is no name of a file") from None


def _toml_text(key: str, text: str) -> str:
    try:
        text.encode()
    except UnicodeEncodeError:
        raise _native.Error(f"settings: {key} = {text!r}: holds what is not UTF-8; name it otherwise") from None
    return json.dumps(text, ensure_ascii=False)


def _toml_value(key: str, value: object) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return _toml_text(key, os.fspath(value))
    raise _native.Error(f"settings: {key} = {value!r}: must be true or false, a number or a text")


def _flat(settings: Mapping[str, object], prefix: str = "") -> Iterator[Tuple[str, object]]:
    for name, value in settings.items():
        key = f"{prefix}{name}"
        if isinstance(value, Mapping):
            yield from _flat(value, f"{key}.")
        else:
            yield key, value


def _toml(settings: Mapping[str, object]) -> str:
    lines = []
    for key, value in _flat(settings):
        if not re.fullmatch(r"\w+(\.\w+)+", key, re.ASCII):
            raise _native.Error(f'settings: "{key}" is no key such as "map.resolution_m"; docs/configuration.md lists '
                                "them all")
        lines.append(f"{key} = {_toml_value(key, value)}\n")
    return "".join(lines)


def map(input: Union[str, os.PathLike[str]], *, output: Union[str, os.PathLike[str], None] = None,
        config: Union[str, os.PathLike[str], None] = None, settings: Optional[Mapping[str, object]] = None,
        beams: Optional[int] = None, calibrate: bool = True, odometry_only: bool = False,
        frontend_only: bool = False, on_progress: Optional[Callable[[float], object]] = None) -> Run:
    """Takes a whole input through the pipeline, as `swiftlet map` does, with the same result.

    input: a capture (.pcap, also in gzip), a table of samples (.csv), a CARMEN laser log (.clf), or a simulated flight
    (sim://office?seed=1).
    output: a directory for the files of `swiftlet map`; without it none are written.
    config: a TOML file with settings. settings: single ones above those, such as {"map.resolution_m": 0.1} or
    {"map": {"resolution_m": 0.1}}; docs/configuration.md lists all.
    beams: of a laser log: how many to keep, 2 to 64, without it 11.
    calibrate: estimate the age of the ranges and the scales of the odometry first.
    odometry_only: correct nothing; frontend_only: walls but no loop closures. Both are baselines.
    on_progress: called ten times a second in this thread with the share of the input that was mapped, 0 to 1.

    Other threads run meanwhile. Ctrl-C, or an exception of on_progress, stops it; a calibration or a final pass that
    has begun is finished first. Raises swiftlet.Error for what cannot be used. An input that is damaged after usable
    samples gives a run of the rest, with a DamagedInputWarning.
    """
    if odometry_only and frontend_only:
        raise _native.Error("odometry_only excludes frontend_only")
    if config is not None and not os.fspath(config):
        raise _native.Error("config names no file; leave it out for the defaults")
    mapped = _native.map_input(
        input=_name_of_file("input", input), output=None if output is None else _name_of_file("output", output),
        config_file=b"" if config is None else _name_of_file("config", config), settings=_toml(settings or {}),
        beams=beams, calibrate=calibrate, odometry_only=odometry_only, frontend_only=frontend_only,
        on_progress=on_progress)
    report = json.loads(mapped.pop("report"))
    if output is None:
        del report["files"]
    storeys = {storey: Grid(**grid) for storey, grid in mapped.pop("grids").items()}
    run = Run(input=os.fspath(input), report=report, grid=storeys[0], storeys=storeys,
              notes=tuple(mapped.pop("notes")), problems=tuple(mapped.pop("problems")), **mapped)
    if run.problems:
        warnings.warn("; ".join(run.problems), DamagedInputWarning, stacklevel=2)
    return run

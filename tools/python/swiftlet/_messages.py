# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""swiftlet.listen() and the messages that it yields. docs/lcm.md says when each is sent, and the .lcm files
(/usr/share/swiftlet/lcm) what each field means."""

from __future__ import annotations

import math
import os
import time
from dataclasses import dataclass
from types import TracebackType
from typing import Any, ClassVar, Dict, Iterable, Iterator, List, Optional, Tuple, Type, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._mapping import Grid


class Timeout(_native.Error, TimeoutError):
    """Nothing was received for as long as the caller waits."""


@dataclass(frozen=True, eq=False)
class Pose:
    """Where the vehicle is, once a sample."""

    time_s: float
    """When the packet with the sample's ranges was received, s since 1970."""
    map_id: int
    """The run. Another one begins with an empty map."""
    sequence: int
    """Counts samples up from 0."""
    segment: int
    """Counts up from 1 with each restart or silence of the vehicle."""
    keyframe: int
    correction_version: int
    """Counts corrections up; a new one may make the pose in frame map jump, by correction_m."""
    correction_m: float
    frame: str
    """map, local or odom."""
    x_m: float
    y_m: float
    yaw_rad: float
    """Counter-clockwise, -pi to pi."""
    storey: int
    """On which the vehicle is, counted up from 0 in the order of first visits."""
    tracking: str
    """good, uncertain, lost or relocalizing."""
    covariance_map: npt.NDArray[np.float64]
    """3 x 3: of (x, y, yaw), relative to the part of the map around the vehicle. Zero in other frames than map."""
    covariance_start: npt.NDArray[np.float64]
    """3 x 3: the same, relative to the start of the run."""


@dataclass(frozen=True, eq=False)
class Ranges:
    """The beams of a sample, in the body frame; they begin at its origin. The Pose of the same sequence is where they
    were measured. In frames map and local it comes before them, in frame odom after them."""

    HIT: ClassVar[int] = 0
    NO_RETURN: ClassVar[int] = 1
    """Nothing within max_range_m."""
    INVALID: ClassVar[int] = 2
    """No measurement, no information."""

    time_s: float
    """As of the Pose."""
    map_id: int
    sequence: int
    """As of the Pose."""
    device_time_s: float
    """When they were measured, on the vehicle's own clock: only differences have a meaning."""
    max_range_m: float
    """What is farther is no return."""
    bearing_rad: npt.NDArray[np.float64]
    """K: counter-clockwise from straight ahead. The same in the whole run."""
    distance_m: npt.NDArray[np.float64]
    """K: from the origin to the hit; 0 where there is none."""
    status: npt.NDArray[np.int8]
    """K: HIT, NO_RETURN or INVALID."""

    def hits_m(self, pose: Pose) -> npt.NDArray[np.float64]:
        """H x 2: x and y of the hits, in the frame of the pose."""
        hit = self.status == self.HIT
        angle_rad = pose.yaw_rad + self.bearing_rad[hit]
        return np.column_stack([pose.x_m + self.distance_m[hit] * np.cos(angle_rad),
                                pose.y_m + self.distance_m[hit] * np.sin(angle_rad)])


@dataclass(frozen=True, eq=False)
class Tile:
    """One square of the map, complete in itself. TileMap puts them together."""

    time_s: float
    map_id: int
    tile_x: int
    tile_y: int
    storey: int
    """As of the Pose: each has a map of its own."""
    version: int
    """Counts up with each change of this tile."""
    resolution_m: float
    """Side of a cell."""
    occupancy_percent: npt.NDArray[np.int8]
    """64 x 64, as of Grid."""

    @property
    def grid(self) -> Grid:
        """The same as a Grid, with its place."""
        rows, columns = self.occupancy_percent.shape
        return Grid(self.occupancy_percent, self.resolution_m,
                    (self.tile_x * columns * self.resolution_m, self.tile_y * rows * self.resolution_m))


@dataclass(frozen=True, eq=False)
class Walls:
    """All walls of a moment."""

    time_s: float
    map_id: int
    ids: npt.NDArray[np.int32]
    """K: each stays the same while its wall is known."""
    storeys: npt.NDArray[np.int8]
    """K: as of the Pose."""
    segments_m: npt.NDArray[np.float64]
    """K x 4: x and y of the start, x and y of the end, in frame map."""


@dataclass(frozen=True)
class Closure:
    """A loop closure, when it is found and again if it is dropped, while flying or in the final pass."""

    time_s: float
    map_id: int
    index: int
    """Counts up from 0; the same index again replaces."""
    from_keyframe: int
    to_keyframe: int
    x_m: float
    """Pose of the keyframe `to` in the frame of `from`, as matched, with its standard deviations."""
    y_m: float
    yaw_rad: float
    sigma_x_m: float
    sigma_y_m: float
    sigma_yaw_rad: float
    score: float
    """Mean probability under the matched points, 0 to 1."""
    dcs_scale: float
    """What the robust kernel leaves of it, 1: fully believed."""
    dropped: bool
    storey: int
    """As of the Pose, of both."""
    from_m: Tuple[float, float]
    """x and y of both keyframes in frame map when this was sent."""
    to_m: Tuple[float, float]


@dataclass(frozen=True)
class VehicleEvent:
    """What the pilot of a live vehicle should act on, unless Status or Pose tells it: the battery, a silence."""

    time_s: float
    map_id: int
    text: str
    """One line: what, and what to do; not for programs."""


@dataclass(frozen=True)
class Link:
    """The link to a live vehicle. Rates are since the status before, counts since the start. None: not known."""

    condition: str
    """none (a recording), connected, silent, device_missing, access_denied, device_busy, device_stalls,
    device_overflows, device_mute, device_fault or device_unsuited."""
    safelink: bool
    ack_rate: Optional[float]
    retries_per_packet: float
    sent_hz: float
    received_hz: float
    round_trip_ms: Optional[float]
    rssi_dbm: Optional[int]
    battery_v: Optional[float]
    flying: Optional[bool]
    packets_sent: int
    packets_acked: int
    packets_received: int
    duplicates: int
    silences: int
    device_losses: int
    usb_timeouts: int
    client: Optional[bool]
    """Whether one is connected; None: the link is not shared."""
    client_setpoints_dropped: int
    client_requests_dropped: int


@dataclass(frozen=True)
class Tracking:
    """What the state of tracking is made of."""

    state: str
    """good, uncertain, lost or relocalizing."""
    contradiction: float
    contradicting_share: float
    returns_compared: int
    times_uncertain: int
    places_weighed: int
    place_lead: float
    innovation: float
    way_since_agreement_m: float
    way_since_closure_m: float
    way_unplaced_m: float


@dataclass(frozen=True)
class Queue:
    """A queue between two threads of swiftletd."""

    name: str
    capacity: int
    high_water: int
    refused: int


@dataclass(frozen=True)
class Stage:
    """How long one stage of the pipeline has taken so far."""

    name: str
    count: int
    mean_ms: float
    p50_ms: float
    p99_ms: float
    p999_ms: float
    max_ms: float


@dataclass(frozen=True)
class Status:
    """How swiftletd is doing, once a second. Counts are since the start of the run."""

    time_s: float
    map_id: int
    state: str
    """running, finishing or finished: the map is final."""
    progress: Optional[float]
    """0 to 1 through a recording; None: the end is not known."""
    sample_rate_hz: float
    frames: int
    samples: int
    gaps: int
    missing_packets: int
    duplicates: int
    out_of_order: int
    unpaired: int
    segments: int
    input_problems: int
    link: Link
    tracking: Tracking
    keyframes: int
    batches_rolled_back: int
    submaps: int
    closures_accepted: int
    closures_dropped: int
    optimizations: int
    solver_failures: int
    tile_count: int
    version_sum: int
    queues: Tuple[Queue, ...]
    stages: Tuple[Stage, ...]
    missed_deadlines: int
    recording: str
    """none, running or failed."""
    recorded_bytes: int


Message = Union[Pose, Ranges, Tile, Walls, Closure, VehicleEvent, Status]

_CHANNELS = {Ranges: "RANGES", Tile: "MAP_TILE", Walls: "LANDMARKS", Closure: "LOOP_CLOSURE",
             VehicleEvent: "VEHICLE_EVENT", Status: "STATUS"}
_POSE_CHANNELS = {"map": "POSE", "local": "POSE_LOCAL", "odom": "POSE_ODOM"}


def _status(fields: Dict[str, Any]) -> Status:
    return Status(link=Link(**fields.pop("link")), tracking=Tracking(**fields.pop("tracking")),
                  queues=tuple(Queue(**queue) for queue in fields.pop("queues")),
                  stages=tuple(Stage(**stage) for stage in fields.pop("stages")), **fields)


def _message(kind: str, fields: Dict[str, Any]) -> Message:
    if kind == "pose":
        return Pose(**fields)
    if kind == "ranges":
        return Ranges(**fields)
    if kind == "tile":
        return Tile(**fields)
    if kind == "walls":
        return Walls(**fields)
    if kind == "closure":
        return Closure(**fields)
    if kind == "event":
        return VehicleEvent(**fields)
    return _status(fields)


def _channels(messages: Iterable[Type[Message]], frames: Iterable[str]) -> List[str]:
    channels: List[str] = []
    for kind in messages:
        if kind is Pose:
            for frame in frames:
                if frame not in _POSE_CHANNELS:
                    raise _native.Error(f"frames: {frame!r} is none of map, local and odom")
                channels.append(_POSE_CHANNELS[frame])
        elif kind in _CHANNELS:
            channels.append(_CHANNELS[kind])
        else:
            raise _native.Error(f"messages: {kind!r} is none of Pose, Ranges, Tile, Walls, Closure, "
                                "VehicleEvent and Status")
    return channels


def _checked(timeout: Optional[float]) -> Optional[float]:
    if timeout is not None and math.isnan(timeout):
        raise _native.Error("timeout = nan: must be seconds, or None to wait for as long as it takes")
    return timeout


def _in_bytes(url: str) -> bytes:
    try:
        return os.fsencode(url)
    except UnicodeEncodeError:
        raise _native.Error(f"url = {url!r}: holds what no address has") from None


class Listener:
    """Receives the messages of swiftletd, from the moment it is made: iterate over it, or call receive(). Up to 1000
    of a channel wait for whoever is slow. One thread at a time."""

    def __init__(self, url: Optional[str] = None, *, messages: Iterable[Type[Message]] = (Pose, Tile, Status),
                 frames: Iterable[str] = ("map",), channel_prefix: Optional[str] = None,
                 timeout: Optional[float] = None, follow: bool = False) -> None:
        """As listen()."""
        self.url = _native.default_lcm_url() if url is None else url
        prefix = _native.default_channel_prefix() if channel_prefix is None else channel_prefix
        self._timeout = _checked(timeout)
        self._follow = follow
        wanted = set(messages)
        self._yields_status = Status in wanted
        channels = _channels(sorted(wanted | {Status}, key=str), tuple(frames))
        self._native: Optional[_native.Listener] = _native.Listener(_in_bytes(self.url), prefix, channels)
        self._has_ended = False

    def receive(self, timeout: Optional[float] = None) -> Optional[Message]:
        """The next message; None when none came within `timeout` seconds, or none will come any more: a log was read
        to its end, or the run has finished and the listener does not follow the next one. Without a timeout it waits
        for as long as it takes."""
        if self._native is None:
            raise _native.Error(f"{self.url}: this listener was closed")
        if self._has_ended and not self._follow:
            return None
        timeout = _checked(timeout)
        end = None if timeout is None else time.monotonic() + timeout
        while True:
            left = None if end is None else max(end - time.monotonic(), 0.0)
            received = self._native.receive(left)
            if received is None:
                return None
            message = _message(*received)
            if isinstance(message, Status):
                self._has_ended = message.state == "finished"
                if not self._yields_status:
                    if self._has_ended and not self._follow:
                        return None
                    continue
            return message

    def close(self) -> None:
        """Receives nothing any more."""
        self._native = None

    def __iter__(self) -> Iterator[Message]:
        return self

    def __next__(self) -> Message:
        if self._native is None or (self._has_ended and not self._follow):
            raise StopIteration
        message = self.receive(self._timeout)
        if message is not None:
            return message
        if self._native.has_ended() or (self._has_ended and not self._follow):
            raise StopIteration
        raise Timeout(f"{self.url}: nothing received for {self._timeout:g} s; is swiftletd running? swiftlet doctor "
                      "checks LCM")

    def __enter__(self) -> Listener:
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()


def listen(url: Optional[str] = None, *, messages: Iterable[Type[Message]] = (Pose, Tile, Status),
           frames: Iterable[str] = ("map",), channel_prefix: Optional[str] = None,
           timeout: Optional[float] = None, follow: bool = False) -> Listener:
    """Iterates over what a running swiftletd publishes, until its run has finished. Late is early enough: each tile is
    sent again every ten seconds.

    url: where swiftletd publishes; without it LCM_DEFAULT_URL, without that this machine. A log of LCM's (file://) is
    read at its pace, or with &speed=0 at once.
    messages: which classes of Pose, Ranges, Tile, Walls, Closure, VehicleEvent and Status.
    frames: of the poses: map, local, odom.
    channel_prefix: publish.channel_prefix of swiftletd's configuration.
    timeout: after so many seconds without a message iterating raises swiftlet.Timeout; without it it waits.
    follow: go on with the next run instead of ending with this one.

    Raises swiftlet.Error for an address that cannot be used.
    """
    return Listener(url, messages=messages, frames=frames, channel_prefix=channel_prefix, timeout=timeout,
                    follow=follow)


class TileMap:
    """The map of a run, put together from its tiles."""

    def __init__(self) -> None:
        self.map_id: Optional[int] = None
        """The run whose tiles it holds."""
        self._tiles: Dict[Tuple[int, int, int], Tile] = {}

    def add(self, tile: Tile) -> bool:
        """Takes a tile: whether it was new. The first tile of another run empties the map."""
        if tile.map_id != self.map_id:
            self._tiles.clear()
            self.map_id = tile.map_id
        place = (tile.tile_x, tile.tile_y, tile.storey)
        if place in self._tiles and self._tiles[place].version >= tile.version:
            return False
        self._tiles[place] = tile
        return True

    def is_complete(self, status: Status) -> bool:
        """Whether it holds the newest of each tile that swiftletd had sent before the status."""
        return (status.map_id == self.map_id and len(self._tiles) == status.tile_count
                and sum(tile.version for tile in self._tiles.values()) == status.version_sum)

    def grid(self, storey: int = 0) -> Grid:
        """What it holds of a storey. A new array. Raises swiftlet.Error where there is no tile yet."""
        tiles = {(x, y): tile for (x, y, of), tile in self._tiles.items() if of == storey}
        if not tiles:
            raise _native.Error(f"this map holds no tile of storey {storey} yet")
        any_tile = next(iter(tiles.values()))
        side = any_tile.occupancy_percent.shape[0]
        left, low = (min(place[axis] for place in tiles) for axis in (0, 1))
        right, high = (max(place[axis] for place in tiles) for axis in (0, 1))
        percent = np.full(((high - low + 1) * side, (right - left + 1) * side), -1, dtype=np.int8)
        for (x, y), tile in tiles.items():
            percent[(y - low) * side:(y - low + 1) * side, (x - left) * side:(x - left + 1) * side] = \
                tile.occupancy_percent
        return Grid(percent, any_tile.resolution_m,
                    (left * side * any_tile.resolution_m, low * side * any_tile.resolution_m))

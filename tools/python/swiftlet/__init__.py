# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""2D SLAM for four range beams: map a recording, or listen to a running swiftletd.

>>> import swiftlet
>>> run = swiftlet.map("flight.pcap")
>>> run.trajectory                      # N x 4: time, x, y, yaw
>>> for message in swiftlet.listen():   # poses, tiles and status of a running swiftletd
...     print(message)

docs/python.md has examples, docs/frames_and_units.md the frames. Lengths are in metres, angles in radians, times in
seconds since 1970 as floats.
"""

from ._mapping import DamagedInputWarning, Grid, Run, map
from ._messages import (
    Closure,
    Link,
    Listener,
    Message,
    Pose,
    Queue,
    Ranges,
    Stage,
    Status,
    Tile,
    TileMap,
    Tracking,
    VehicleEvent,
    Walls,
    listen,
)
from ._messages import Timeout
from ._native import Error
from ._native import version as _version

__version__: str = _version().split()[1]

__all__ = [
    "Closure",
    "DamagedInputWarning",
    "Error",
    "Grid",
    "Link",
    "Listener",
    "Message",
    "Pose",
    "Queue",
    "Ranges",
    "Run",
    "Stage",
    "Status",
    "Tile",
    "TileMap",
    "Timeout",
    "Tracking",
    "VehicleEvent",
    "Walls",
    "listen",
    "map",
]

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

import {boundsWith} from "./bounds.js";

const GOOD = 0;  // `tracking` of a pose, as in pose_t

/// What was measured since the drone's place is in doubt, which the map does not show until it is known. Kept in frame
/// local, where no correction moves it.
export class WaitingReturns {
  constructor(model) {
    this.model = model;
    [this.first, this.end, this.path, this.bounds, this.ofPoses] = [null, 0, null, null, -1];
  }

  /// {path, bounds, T_map_local} at the pose of that index: a dot of no size for each return, in metres, and the
  /// rectangle in frame local that holds these and the poses; null: nothing waits.
  at(index) {
    const {poses, posesVersion} = this.model;
    const begin = firstWaiting(poses, index);
    if (begin > index) return null;
    if (poses[begin] !== this.first || posesVersion !== this.ofPoses || this.end > index + 1)
      [this.first, this.end, this.path, this.bounds, this.ofPoses] =
        [poses[begin], begin, new Path2D(), null, posesVersion];
    for (; this.end <= index; ++this.end) this.add(poses[this.end]);
    return {path: this.path, bounds: this.bounds, T_map_local: mapFromLocal(poses[index])};
  }

  add(pose) {
    this.bounds = boundsWith(this.bounds, pose.local);
    for (const [x, y] of this.model.hitsOf(pose, "local")) {
      this.path.moveTo(x, y);
      this.path.lineTo(x, y);
      this.bounds = boundsWith(this.bounds, [x, y]);
    }
  }

  /// The corners of that rectangle in frame map; none: nothing waits.
  cornersAt(index) {
    const waiting = this.at(index);
    if (waiting === null) return [];
    const {bounds: {low, high}, T_map_local: [x, y, yaw]} = waiting;
    const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
    return [low, high, [low[0], high[1]], [high[0], low[1]]].map(([dx, dy]) => [x + c * dx - s * dy, y + s * dx + c * dy]);
  }
}

/// The first pose of the same doubt, segment and storey; index + 1 if the pose is in no doubt.
function firstWaiting(poses, index) {
  const now = poses[index];
  let first = index + 1;
  while (first > 0 && poses[first - 1].tracking > GOOD && poses[first - 1].segment === now.segment &&
         poses[first - 1].storey === now.storey)
    first -= 1;
  return first;
}

/// [x, y, yaw] of frame local in frame map, by that pose.
function mapFromLocal({map, local}) {
  const turn_rad = map[2] - local[2];
  const [c, s] = [Math.cos(turn_rad), Math.sin(turn_rad)];
  return [map[0] - c * local[0] + s * local[1], map[1] - s * local[0] - c * local[1], turn_rad];
}

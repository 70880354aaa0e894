// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

const GOOD = 0;  // `tracking` of a pose, as in pose_t

/// What was measured since the drone's place is in doubt, which the map does not show until it is known. Kept in frame
/// local, where no correction moves it.
export class WaitingReturns {
  constructor(model) {
    this.model = model;
    [this.first, this.end, this.path, this.ofPoses] = [null, 0, null, -1];
  }

  /// {path, T_map_local} at the pose of that index: a dot of no size for each return, in metres; null: nothing waits.
  at(index) {
    const {poses, posesVersion} = this.model;
    const begin = firstWaiting(poses, index);
    if (begin > index) return null;
    if (poses[begin] !== this.first || posesVersion !== this.ofPoses || this.end > index + 1)
      [this.first, this.end, this.path, this.ofPoses] = [poses[begin], begin, new Path2D(), posesVersion];
    for (; this.end <= index; ++this.end)
      for (const [x, y] of this.model.hitsOf(poses[this.end], "local")) {
        this.path.moveTo(x, y);
        this.path.lineTo(x, y);
      }
    return {path: this.path, T_map_local: mapFromLocal(poses[index])};
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

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

const MAX_POSES = 80_000;

/// What the page knows of the run. Positions in metres and radians, frame map, unless named otherwise.
export class RunModel {
  constructor() {
    this.posesVersion = 0;  // counts up when poses are forgotten: what was derived of them is void
    this.begin({generation: 0, map_id: "", title: "", is_recording: false, rate: 1});
  }

  begin(run) {
    this.run = run;
    this.poses = [];
    this.posesVersion += 1;
    this.bearings = [];  // of the beams, in the body frame
    this.storey = 0;     // that is shown
    this.hasStoreys = false;
    this.walls = [];
    this.closures = new Map();
    this.events = [];
    this.status = null;
    this.resolution_m = 0;
  }

  addPoses(poses, bearings) {
    this.bearings = bearings;
    for (const pose of poses) {
      const before = this.poses[this.poses.length - 1];
      pose.travel_m = travelTo(before, pose);
      if (before?.segment !== pose.segment || before.storey !== pose.storey) this.rawStart = pose;
      pose.raw = rawPlace(this.rawStart, pose);
      this.poses.push(pose);
      this.hasStoreys ||= pose.storey > 0;
    }
    if (this.poses.length > MAX_POSES) this.thinPoses();
  }

  thinPoses() {
    const half = this.poses.length >> 1;
    this.poses = this.poses.filter((_, i) => i >= half || i % 2 === 0);
    this.posesVersion += 1;
  }

  get first_us() {
    return this.poses.length > 0 ? this.poses[0].utime_us : 0;
  }

  get newest_us() {
    return this.poses.length > 0 ? this.poses[this.poses.length - 1].utime_us : 0;
  }

  /// Of the newest pose that is not after at_us; -1: none. null: the newest of all.
  indexAt(at_us) {
    if (at_us === null) return this.poses.length - 1;
    let [low, high] = [0, this.poses.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.poses[middle].utime_us <= at_us) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  poseAt(at_us) {
    return this.poses[this.indexAt(at_us)] ?? null;
  }

  /// Where the beams of a pose ended. `frame`: "map" or "local".
  hitsOf(pose, frame = "map") {
    const [x, y, yaw] = pose[frame];
    return pose.ranges.map((range, i) => [range, yaw + this.bearings[i]])
      .filter(([range]) => range > 0)
      .map(([range, angle]) => [x + range * Math.cos(angle), y + range * Math.sin(angle)]);
  }

  addClosures(closures) {
    for (const closure of closures) this.closures.set(closure.index, closure);
  }

  /// Those that were believed at that moment.
  closuresAt(at_us) {
    const moment_us = at_us ?? Infinity;
    const isBelieved = (c) => c.found_us <= moment_us && (c.dropped_us === 0 || c.dropped_us > moment_us);
    return [...this.closures.values()].filter(isBelieved);
  }

  /// Of these, on the storey that is shown.
  closuresShown(at_us) {
    return this.closuresAt(at_us).filter((closure) => closure.storey === this.storey);
  }
}

/// Where dead reckoning alone puts the pose in frame map, if it was right at `start`.
function rawPlace(start, pose) {
  const turn_rad = start.map[2] - start.odom[2];
  const [dx, dy] = [pose.odom[0] - start.odom[0], pose.odom[1] - start.odom[1]];
  const [c, s] = [Math.cos(turn_rad), Math.sin(turn_rad)];
  return [start.map[0] + c * dx - s * dy, start.map[1] + s * dx + c * dy];
}

/// Metres flown since the beginning, by dead reckoning.
function travelTo(before, pose) {
  if (!before) return 0;
  if (before.segment !== pose.segment) return before.travel_m;
  return before.travel_m + Math.hypot(pose.odom[0] - before.odom[0], pose.odom[1] - before.odom[1]);
}

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

const BLOCK = 512;        // poses in a path that is kept
const JUMP_m = 0.25;      // a correction that moves the pose farther breaks the line

/// A trail as paths in metres, those of whole blocks kept from frame to frame.
export class TrailPaths {
  /// `member` of a pose: "map" or "raw".
  constructor(model, member) {
    this.model = model;
    this.member = member;
    this.blocks = [];
    this.ofPoses = "";
  }

  /// Strokes the poses from index `from` to index `to` (inclusive) with the context's style.
  stroke(context, from, to) {
    this.forgetOld();
    let index = from;
    while (index < to) {
      const block = Math.floor(index / BLOCK);
      const isWhole = index % BLOCK === 0 && to >= index + BLOCK;
      const end = Math.min(to, (block + 1) * BLOCK);
      context.stroke(isWhole ? (this.blocks[block] ??= this.path(index, end)) : this.path(index, end));
      index = end;
    }
  }

  forgetOld() {
    const poses = `${this.model.posesVersion} ${this.model.storey}`;
    if (poses !== this.ofPoses) this.blocks = [];
    this.ofPoses = poses;
  }

  path(from, to) {
    const path = new Path2D();
    for (const line of trailLines(this.model.poses, this.member, from, to, this.model.storey)) {
      path.moveTo(line[0][0], line[0][1]);
      for (let i = 1; i < line.length; ++i) path.lineTo(line[i][0], line[i][1]);
    }
    return path;
  }
}

/// Lists of points: the trail on a storey, interrupted where the pose jumped.
export function trailLines(poses, member, from, to, storey) {
  const lines = [];
  let before = null;
  for (let i = from; i <= to && i < poses.length; ++i) {
    const pose = poses[i];
    if (pose.storey !== storey) {
      before = null;
      continue;
    }
    if (before === null || isBroken(before, pose, member)) lines.push([]);
    lines[lines.length - 1].push(pose[member]);
    before = pose;
  }
  return lines;
}

function isBroken(before, pose, member) {
  if (member === "raw") return before.segment !== pose.segment;
  if (before.correction === pose.correction && before.segment === pose.segment) return false;
  return Math.hypot(pose.map[0] - before.map[0], pose.map[1] - before.map[1]) > JUMP_m;
}

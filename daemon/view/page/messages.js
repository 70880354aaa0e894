// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// The messages of the WebSocket /live; daemon/view/page_messages.hpp has their layout.

const POSES_KIND = 1;
const WALLS_KIND = 2;
const TILES_KIND = 3;
const HEADER_BYTES = 16;
const POSE_BYTES = 88;  // without the ranges
const WALL_BYTES = 20;
export const TILE_CELLS = 64;
const CELLS_IN_TILE = TILE_CELLS * TILE_CELLS;
const TILE_BYTES = 12 + CELLS_IN_TILE;
// `state` of a status, as in status_t.
export const RUNNING = 0;
export const FINISHED = 2;

function floatsAt(view, offset, count) {
  return Array.from({length: count}, (_, i) => view.getFloat32(offset + 4 * i, true));
}

function poseAt(view, offset, beams) {
  return {
    utime_us: view.getFloat64(offset, true),
    map: floatsAt(view, offset + 8, 3),
    local: floatsAt(view, offset + 20, 3),
    odom: floatsAt(view, offset + 32, 3),
    sequence: view.getInt32(offset + 44, true),
    segment: view.getInt32(offset + 48, true),
    correction: view.getInt32(offset + 52, true),
    tracking: view.getInt32(offset + 56, true),
    storey: view.getInt32(offset + 60, true),
    covariance: floatsAt(view, offset + 64, 6),
    ranges: floatsAt(view, offset + POSE_BYTES, beams),
  };
}

function posesOf(view, count, beams) {
  const first = HEADER_BYTES + 4 * beams;
  const bytes = POSE_BYTES + 4 * beams;
  return {
    type: "poses",
    bearings: floatsAt(view, HEADER_BYTES, beams),
    poses: Array.from({length: count}, (_, i) => poseAt(view, first + i * bytes, beams)),
  };
}

function wallAt(view, offset) {
  return {id: view.getInt32(offset, true), ends: floatsAt(view, offset + 4, 4)};
}

function tileAt(view, offset) {
  return {
    x: view.getInt32(offset, true),
    y: view.getInt32(offset + 4, true),
    version: view.getInt32(offset + 8, true),
    cells: new Int8Array(view.buffer, offset + 12, CELLS_IN_TILE).slice(),
  };
}

function records(view, count, bytes, recordAt) {
  return Array.from({length: count}, (_, i) => recordAt(view, HEADER_BYTES + i * bytes));
}

/// An object with the member `type`, as the JSON messages have.
export function decodeMessage(data) {
  if (typeof data === "string") return JSON.parse(data);
  const view = new DataView(data);
  const [kind, count, value] = [view.getUint32(0, true), view.getUint32(4, true), view.getFloat64(8, true)];
  switch (kind) {
    case POSES_KIND:
      return posesOf(view, count, value);
    case WALLS_KIND:
      return {type: "walls", utime_us: value, walls: records(view, count, WALL_BYTES, wallAt)};
    case TILES_KIND:
      return {type: "tiles", resolution_m: value, tiles: records(view, count, TILE_BYTES, tileAt)};
    default:
      return {type: "unknown"};
  }
}

export function momentRequest(at_us) {
  return JSON.stringify({at: at_us === null ? null : Math.round(at_us)});
}

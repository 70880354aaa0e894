// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// The map as ROS's map_server reads it, byte for byte as daemon/outputs/ros_map.cpp writes it.

import {TILE_CELLS} from "./messages.js";

const [OCCUPIED, FREE, UNKNOWN] = [0, 254, 205];

function pgmValue(percent) {
  if (percent < 0) return UNKNOWN;
  if (percent >= 65) return OCCUPIED;
  return percent < 45 ? FREE : UNKNOWN;
}

function rangeOf(tileMap) {
  return tileMap.tileRange() ?? {low: [0, 0], high: [0, 0]};
}

export function pgmBytes(tileMap) {
  const {low, high} = rangeOf(tileMap);
  const [width, height] = [0, 1].map((axis) => (high[axis] - low[axis] + 1) * TILE_CELLS);
  const header = new TextEncoder().encode(`P5\n${width} ${height}\n255\n`);
  const bytes = new Uint8Array(header.length + width * height).fill(UNKNOWN);
  bytes.set(header);
  for (const tile of tileMap.tiles.values()) {
    if (!tile.isKnown) continue;
    tile.cells.forEach((percent, i) => {
      const column = (tile.x - low[0]) * TILE_CELLS + i % TILE_CELLS;
      const row = height - 1 - ((tile.y - low[1]) * TILE_CELLS + Math.floor(i / TILE_CELLS));
      bytes[header.length + row * width + column] = pgmValue(percent);
    });
  }
  return bytes;
}

export function yamlText(tileMap, resolution_m, pgmName) {
  const origin = rangeOf(tileMap).low.map((tile) => (tile * TILE_CELLS * resolution_m).toFixed(6));
  return `image: ${pgmName}\nmode: trinary\nresolution: ${resolution_m.toFixed(6)}\n` +
    `origin: [${origin.join(", ")}, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n`;
}

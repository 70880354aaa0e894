// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

import {boundsWith} from "./bounds.js";
import {TILE_CELLS} from "./messages.js";

const CHUNK_TILES = 8;  // along a side: a canvas of 512 pixels
const CHUNK_CELLS = CHUNK_TILES * TILE_CELLS;
const WHITE_UP_TO_PERCENT = 42;
const DARK_FROM_PERCENT = 90;

/// The colour of each occupancy as a 32-bit pixel, unknown at index 255.
export function occupancyPixels(colours) {
  const pixels = new Uint32Array(256);
  for (let percent = 0; percent <= 100; ++percent) {
    const share = Math.min(1, Math.max(0, (percent - WHITE_UP_TO_PERCENT) / (DARK_FROM_PERCENT - WHITE_UP_TO_PERCENT)));
    const [r, g, b] = colours.paper.map((part, i) => Math.round(part + share * (colours.ink[i] - part)));
    pixels[percent] = (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;
  }
  return pixels;
}

/// The occupancy map: the tiles' content, and their pixels in canvases of 8x8 tiles.
export class TileMap {
  constructor(colours) {
    this.tiles = new Map();
    this.chunks = new Map();
    this.pixels = occupancyPixels(colours);
    this.image = new ImageData(TILE_CELLS, TILE_CELLS);
  }

  clear() {
    this.tiles.clear();
    this.chunks.clear();
  }

  setColours(colours) {
    this.pixels = occupancyPixels(colours);
    for (const tile of this.tiles.values()) this.paint(tile);
  }

  set(tile) {
    const key = `${tile.x},${tile.y}`;
    if (tile.version === 0) this.tiles.delete(key);
    else this.tiles.set(key, tile);
    tile.isKnown = tile.cells.some((percent) => percent >= 0);
    this.paint(tile);
  }

  paint(tile) {
    const out = new Uint32Array(this.image.data.buffer);
    for (let row = 0; row < TILE_CELLS; ++row) {
      const to = (TILE_CELLS - 1 - row) * TILE_CELLS;
      for (let column = 0; column < TILE_CELLS; ++column)
        out[to + column] = this.pixels[tile.cells[row * TILE_CELLS + column] & 255];
    }
    const [chunk, column, row] = this.chunkOf(tile);
    chunk.context.putImageData(this.image, column * TILE_CELLS, (CHUNK_TILES - 1 - row) * TILE_CELLS);
  }

  chunkOf(tile) {
    const [x, y] = [Math.floor(tile.x / CHUNK_TILES), Math.floor(tile.y / CHUNK_TILES)];
    const key = `${x},${y}`;
    if (!this.chunks.has(key)) this.chunks.set(key, makeChunk(x, y));
    return [this.chunks.get(key), tile.x - x * CHUNK_TILES, tile.y - y * CHUNK_TILES];
  }

  /// In tiles, both corners included, of those that hold anything; null: none does.
  tileRange() {
    const known = [...this.tiles.values()].filter((tile) => tile.isKnown);
    if (known.length === 0) return null;
    const range = {low: [known[0].x, known[0].y], high: [known[0].x, known[0].y]};
    for (const tile of known) {
      range.low = [Math.min(range.low[0], tile.x), Math.min(range.low[1], tile.y)];
      range.high = [Math.max(range.high[0], tile.x), Math.max(range.high[1], tile.y)];
    }
    return range;
  }

  /// The rectangle around all known cells in metres; null: there are none.
  bounds(resolution_m) {
    let bounds = null;
    for (const tile of this.tiles.values()) {
      const cells = (tile.knownCells ??= knownCells(tile));
      if (cells !== null) bounds = boundsWith(boundsWith(bounds, cells.low), cells.high);
    }
    if (bounds === null) return null;
    const inMetres = (corner) => corner.map((cell) => cell * resolution_m);
    return {low: inMetres(bounds.low), high: inMetres(bounds.high)};
  }

  /// Percent at a place in metres, -1 where nothing is known.
  percentAt([x_m, y_m], resolution_m) {
    const [column, row] = [Math.floor(x_m / resolution_m), Math.floor(y_m / resolution_m)];
    const tile = this.tiles.get(`${Math.floor(column / TILE_CELLS)},${Math.floor(row / TILE_CELLS)}`);
    if (!tile) return -1;
    return tile.cells[(row - tile.y * TILE_CELLS) * TILE_CELLS + column - tile.x * TILE_CELLS];
  }

  /// On a context that draws in metres. Chunks outside `isSeen` are left out.
  draw(context, resolution_m, isSeen) {
    const side_m = CHUNK_CELLS * resolution_m;
    for (const chunk of this.chunks.values()) {
      const [x_m, y_m] = [chunk.x * side_m, chunk.y * side_m];
      if (!isSeen(x_m, y_m, side_m)) continue;
      context.save();
      context.transform(resolution_m, 0, 0, -resolution_m, x_m, y_m + side_m);
      context.drawImage(chunk.canvas, 0, 0);
      context.restore();
    }
  }
}

function makeChunk(x, y) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = CHUNK_CELLS;
  return {x, y, canvas, context: canvas.getContext("2d")};
}

/// The rectangle of a tile's known cells, in cells of the map; null: there are none.
function knownCells(tile) {
  let [left, bottom, right, top] = [TILE_CELLS, TILE_CELLS, -1, -1];
  tile.cells.forEach((percent, i) => {
    if (percent < 0) return;
    const [column, row] = [i % TILE_CELLS, Math.floor(i / TILE_CELLS)];
    [left, right] = [Math.min(left, column), Math.max(right, column)];
    [bottom, top] = [Math.min(bottom, row), Math.max(top, row)];
  });
  if (right < 0) return null;
  const [x, y] = [tile.x * TILE_CELLS, tile.y * TILE_CELLS];
  return {low: [x + left, y + bottom], high: [x + right + 1, y + top + 1]};
}

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// A page on paper with the map at a round scale and its measures: lines and texts in millimetres, y up, from which
// SVG (here) and PDF (sheet_pdf.js) are written.

import {TILE_CELLS} from "./messages.js";
import {PRINT_COLOURS} from "./theme.js";
import {occupancyPixels} from "./tile_map.js";
import {trailLines} from "./trail_paths.js";
import {durationText, gridStep_m, lengthText} from "./units.js";

const MARGIN_mm = 22;
const LONG_SIDE_mm = 420;   // A3
const SHORT_SIDE_mm = 297;
const SCALES = [10, 20, 25, 50, 100, 125, 200, 250, 500, 1000, 2000, 5000, 10_000];

/// {size_mm, lines: [{points, colour, width_mm}], texts: [{at, text, size_mm, anchor, turned}], image or null}
export function makeSheet(model, tileMap, layers, at_us, isPlan) {
  const bounds = tileMap.bounds(model.resolution_m) ?? {low: [-1, -1], high: [1, 1]};
  const frame = frameOf(bounds);
  const sheet = {size_mm: frame.size_mm, lines: [], texts: [], image: null};
  if (!isPlan && layers.map) sheet.image = imageOf(tileMap, model.resolution_m, frame);
  if (isPlan || layers.walls) addWalls(sheet, frame, model);
  if (!isPlan) addTrails(sheet, frame, model, layers, at_us);
  if (!isPlan && layers.closures) addClosures(sheet, frame, model, at_us);
  addMeasures(sheet, frame, bounds);
  addTitle(sheet, frame, model, at_us);
  return sheet;
}

function frameOf({low, high}) {
  const extent_m = [high[0] - low[0], high[1] - low[1]];
  const isWide = extent_m[0] >= extent_m[1];
  const size_mm = isWide ? [LONG_SIDE_mm, SHORT_SIDE_mm] : [SHORT_SIDE_mm, LONG_SIDE_mm];
  const room_mm = size_mm.map((side) => side - 2 * MARGIN_mm);
  const fits = (scale) => extent_m.every((length_m, axis) => length_m * 1000 / scale <= room_mm[axis]);
  const scale = SCALES.find(fits) ?? SCALES[SCALES.length - 1];
  const toSheet = (point) => [0, 1].map((axis) => size_mm[axis] / 2 + (point[axis] - (low[axis] + high[axis]) / 2) * 1000 / scale);
  return {size_mm, scale, toSheet};
}

function imageOf(tileMap, resolution_m, frame) {
  const range = tileMap.tileRange();
  if (range === null) return null;
  const low = frame.toSheet(range.low.map((tile) => tile * TILE_CELLS * resolution_m));
  const high = frame.toSheet(range.high.map((tile) => (tile + 1) * TILE_CELLS * resolution_m));
  return {range, low, high};
}

function addWalls(sheet, frame, model) {
  for (const {ends: [x0, y0, x1, y1]} of model.walls)
    sheet.lines.push({points: [frame.toSheet([x0, y0]), frame.toSheet([x1, y1])], colour: "#1a2028", width_mm: 0.5});
}

function addTrails(sheet, frame, model, layers, at_us) {
  const add = (member, colour) => {
    for (const line of trailLines(model.poses, member, 0, model.indexAt(at_us), model.storey))
      sheet.lines.push({points: line.map((point) => frame.toSheet(point)), colour, width_mm: 0.35});
  };
  if (layers.raw) add("raw", PRINT_COLOURS.raw);
  if (layers.trail) add("map", PRINT_COLOURS.trail);
}

function addClosures(sheet, frame, model, at_us) {
  for (const {from_map, to_map} of model.closuresShown(at_us))
    sheet.lines.push({points: [frame.toSheet(from_map), frame.toSheet(to_map)], colour: PRINT_COLOURS.closure, width_mm: 0.18});
}

function addMeasures(sheet, frame, {low, high}) {
  const line = (from, to) => sheet.lines.push({points: [from, to], colour: "#5d6b78", width_mm: 0.18});
  const [a, b] = [frame.toSheet(low), frame.toSheet(high)];
  const [below, left] = [a[1] - 7, a[0] - 7];
  line([a[0], below], [b[0], below]);
  line([left, a[1]], [left, b[1]]);
  for (const x of [a[0], b[0]]) line([x, below - 2], [x, below + 2]);
  for (const y of [a[1], b[1]]) line([left - 2, y], [left + 2, y]);
  const text = (length_m, at, turned) => sheet.texts.push({at, text: `${length_m.toFixed(2)} m`, size_mm: 3.5, anchor: "middle", turned});
  text(high[0] - low[0], [(a[0] + b[0]) / 2, below - 4.5], false);
  text(high[1] - low[1], [left - 2, (a[1] + b[1]) / 2], true);
}

function addTitle(sheet, frame, model, at_us) {
  const [date, flown_s] = [new Date(model.first_us / 1000), ((at_us ?? model.newest_us) - model.first_us) / 1e6];
  const title = model.run.is_recording ? model.run.title.split("/").pop() : "swiftlet";
  sheet.texts.push({at: [MARGIN_mm / 2, sheet.size_mm[1] - 9], text: title, size_mm: 5, anchor: "start", turned: false});
  const facts = `${date.toISOString().slice(0, 16).replace("T", " ")} UTC, ${durationText(flown_s)} flown, 1:${frame.scale} on A3`;
  sheet.texts.push({at: [MARGIN_mm / 2, sheet.size_mm[1] - 14], text: facts, size_mm: 3, anchor: "start", turned: false});
  const bar_m = gridStep_m(30 * frame.scale / 1000);
  const [x, y, end] = [MARGIN_mm / 2, 7, MARGIN_mm / 2 + bar_m * 1000 / frame.scale];
  sheet.lines.push({points: [[x, y + 1.5], [x, y], [end, y], [end, y + 1.5]], colour: "#1a2028", width_mm: 0.35});
  sheet.texts.push({at: [end + 2, y], text: `${lengthText(bar_m, bar_m)} m`, size_mm: 3, anchor: "start", turned: false});
}

/// A canvas with a pixel for each cell of those tiles.
export function tilesPicture(tileMap, {low, high}) {
  const canvas = document.createElement("canvas");
  canvas.width = (high[0] - low[0] + 1) * TILE_CELLS;
  canvas.height = (high[1] - low[1] + 1) * TILE_CELLS;
  const context = canvas.getContext("2d");
  const image = new ImageData(TILE_CELLS, TILE_CELLS);
  const out = new Uint32Array(image.data.buffer);
  const pixels = occupancyPixels(PRINT_COLOURS);
  pixels[255] = 0xffece8e4;  // the unknown, as bytes from the last
  context.fillStyle = PRINT_COLOURS.unknown;
  context.fillRect(0, 0, canvas.width, canvas.height);
  for (const tile of tileMap.tiles.values()) {
    tile.cells.forEach((percent, i) => out[(TILE_CELLS - 1 - (i >> 6)) * TILE_CELLS + (i & 63)] = pixels[percent & 255]);
    context.putImageData(image, (tile.x - low[0]) * TILE_CELLS, (high[1] - tile.y) * TILE_CELLS);
  }
  return canvas;
}

const escaped = (text) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

export function sheetSvg(sheet, picture) {
  const [width, height] = sheet.size_mm;
  const n = (number) => number.toFixed(2);
  const place = ([x, y]) => `${n(x)},${n(height - y)}`;
  const image = picture && `<image x="${n(sheet.image.low[0])}" y="${n(height - sheet.image.high[1])}" ` +
    `width="${n(sheet.image.high[0] - sheet.image.low[0])}" height="${n(sheet.image.high[1] - sheet.image.low[1])}" ` +
    `preserveAspectRatio="none" image-rendering="pixelated" href="${picture.toDataURL("image/png")}"/>`;
  const lines = sheet.lines.map(({points, colour, width_mm}) =>
    `<polyline points="${points.map(place).join(" ")}" fill="none" stroke="${colour}" stroke-width="${width_mm}"/>`);
  const texts = sheet.texts.map(({at, text, size_mm, anchor, turned}) =>
    `<text x="0" y="0" font-family="sans-serif" font-size="${size_mm}" text-anchor="${anchor}" fill="#1d2731" ` +
    `transform="translate(${place(at)})${turned ? " rotate(-90)" : ""}">${escaped(text)}</text>`);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}mm" height="${height}mm" viewBox="0 0 ${width} ${height}">\n` +
    ['<rect width="100%" height="100%" fill="#fff"/>', image, ...lines, ...texts].filter(Boolean).join("\n") + "\n</svg>\n";
}

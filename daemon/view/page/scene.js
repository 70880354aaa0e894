// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

import {FINISHED} from "./messages.js";
import {TrailPaths} from "./trail_paths.js";
import {gridStep_m, lengthText} from "./units.js";
import {WaitingReturns} from "./waiting_returns.js";

const GRID_MIN_px = 56;
const SCALE_BAR_px = 130;
const FLASH_us = 3e6;
const WAITING_px = 3;
const FULL_SCALE_px = 40;  // a metre; where it is less, lines are thinner, down to half
const ELLIPSE_SIGMAS = 2.4477;  // holds 95 % in two dimensions
const FONT = "12px system-ui, sans-serif";

/// Draws the run on a canvas. `layers` says which parts: names to booleans.
export class Scene {
  constructor(model, tileMap, layers) {
    this.model = model;
    this.tileMap = tileMap;
    this.layers = layers;
    this.corrected = new TrailPaths(model, "map");
    this.raw = new TrailPaths(model, "raw");
    this.waiting = new WaitingReturns(model);
  }

  /// frame: {context, transform, colours, pixelRatio, at_us, measure}
  draw(frame) {
    const {context, transform, colours, pixelRatio} = frame;
    context.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
    context.fillStyle = colours.unknown;
    context.fillRect(0, 0, ...transform.size);
    transform.apply(context, pixelRatio);
    if (this.layers.map) this.drawMap(frame);
    if (this.layers.waiting) this.drawWaiting(frame);
    if (this.layers.grid) this.drawGrid(frame);
    if (this.layers.raw) this.drawRaw(frame);
    if (this.layers.trail) this.drawTrail(frame);
    if (this.layers.walls) this.drawWalls(frame);
    if (this.layers.closures) this.drawClosures(frame);
    if (this.layers.beams) this.drawBeams(frame);
    if (this.layers.drone) this.drawDrone(frame);
    context.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
    if (this.layers.grid) this.drawGridLabels(frame);
    this.drawScaleBar(frame);
    if (frame.measure) this.drawMeasure(frame);
  }

  drawMap({context, transform}) {
    if (this.model.resolution_m === 0) return;
    context.imageSmoothingEnabled = transform.scale_px * this.model.resolution_m < 2;
    const reach_m = Math.hypot(...transform.size) / 2 / transform.scale_px;
    const [x, y] = transform.center;
    this.tileMap.draw(context, this.model.resolution_m, (left, bottom, side) =>
      left < x + reach_m && left + side > x - reach_m && bottom < y + reach_m && bottom + side > y - reach_m);
  }

  /// The final map has all.
  doesAnythingWait(at_us) {
    return this.model.status?.state !== FINISHED || (at_us ?? Infinity) < this.model.newest_us;
  }

  /// In metres: the drone, and around what the map does not show yet.
  placesToSee(at_us) {
    const index = this.model.indexAt(at_us);
    if (index < 0 || this.model.poses[index].storey !== this.model.storey) return [];
    const waiting = this.doesAnythingWait(at_us) ? this.waiting.cornersAt(index) : [];
    return [this.model.poses[index].map, ...waiting];
  }

  drawWaiting({context, transform, colours, at_us}) {
    const waiting = this.doesAnythingWait(at_us) ? this.waiting.at(this.model.indexAt(at_us)) : null;
    if (waiting === null) return;
    const [x, y, yaw] = waiting.T_map_local;
    context.save();
    context.translate(x, y);
    context.rotate(yaw);
    context.strokeStyle = colours.waiting;
    context.lineCap = "round";
    context.lineWidth = Math.max(this.model.resolution_m, WAITING_px / transform.scale_px);
    context.stroke(waiting.path);
    context.restore();
  }

  drawGrid({context, transform, colours}) {
    const step_m = gridStep_m(GRID_MIN_px / transform.scale_px);
    const reach_m = Math.hypot(...transform.size) / 2 / transform.scale_px;
    const [x, y] = transform.center;
    const range = (middle) => [Math.ceil((middle - reach_m) / step_m), Math.floor((middle + reach_m) / step_m)];
    const [[left, right], [bottom, top]] = [range(x), range(y)];
    const line = (isAxis, ...ends) => strokeLine(context, isAxis ? colours.axis : colours.grid, 1 / transform.scale_px, ends);
    for (let i = left; i <= right; ++i) line(i === 0, i * step_m, y - reach_m, i * step_m, y + reach_m);
    for (let i = bottom; i <= top; ++i) line(i === 0, x - reach_m, i * step_m, x + reach_m, i * step_m);
  }

  drawGridLabels({context, transform, colours}) {
    const [origin_x, origin_y] = transform.toScreen([0, 0]);
    label(context, colours, "0, 0", origin_x + 5, origin_y - 6, "left");
    if (transform.turn_rad !== 0) return;
    const step_m = gridStep_m(GRID_MIN_px / transform.scale_px);
    const [left, top] = transform.toMap([0, 0]);
    const [right, bottom] = transform.toMap(transform.size);
    for (let i = Math.ceil((left + 40 / transform.scale_px) / step_m); i * step_m < right; ++i)
      label(context, colours, lengthText(i * step_m, step_m), transform.toScreen([i * step_m, 0])[0], 14, "center");
    for (let i = Math.ceil((bottom + 44 / transform.scale_px) / step_m); i * step_m < top - 30 / transform.scale_px; ++i)
      label(context, colours, lengthText(i * step_m, step_m), 6, transform.toScreen([0, i * step_m])[1] + 4, "left");
  }

  drawTrail({context, transform, colours, at_us}) {
    const now = this.model.indexAt(at_us);
    context.lineJoin = "round";
    context.lineWidth = width_m(2, transform);
    if (at_us !== null) {
      context.strokeStyle = colours.later;
      this.corrected.stroke(context, Math.max(0, now), this.model.poses.length - 1);
    }
    context.strokeStyle = colours.trail;
    this.corrected.stroke(context, 0, now);
  }

  drawRaw({context, transform, colours, at_us}) {
    context.strokeStyle = colours.raw;
    context.lineWidth = width_m(1.25, transform);
    context.setLineDash([6 / transform.scale_px, 4 / transform.scale_px]);
    this.raw.stroke(context, 0, this.model.indexAt(at_us));
    context.setLineDash([]);
  }

  drawWalls({context, transform, colours}) {
    context.strokeStyle = colours.wall;
    context.lineWidth = width_m(2.5, transform);
    context.lineCap = "round";
    context.beginPath();
    for (const {ends: [x0, y0, x1, y1]} of this.model.walls) {
      context.moveTo(x0, y0);
      context.lineTo(x1, y1);
    }
    context.stroke();
    context.lineCap = "butt";
  }

  drawClosures({context, transform, colours, at_us}) {
    const now_us = at_us ?? this.model.newest_us;
    for (const closure of this.model.closuresShown(at_us)) {
      const age = Math.max(0, now_us - closure.found_us) / FLASH_us;  // its pose may be on the way
      context.globalAlpha = age < 1 ? 1 : 0.28;
      strokeLine(context, colours.closure, width_m(age < 1 ? 2.5 : 1.25, transform), [...closure.from_map, ...closure.to_map]);
      if (age < 1) ring(context, colours.closure, closure.to_map, (8 + 26 * age) / transform.scale_px, 2 / transform.scale_px);
    }
    context.globalAlpha = 1;
  }

  drawBeams({context, transform, colours, at_us}) {
    const pose = this.model.poseAt(at_us);
    if (pose === null) return;
    const hits = this.model.hitsOf(pose);
    context.strokeStyle = colours.beam;
    context.lineWidth = 1.5 / transform.scale_px;
    context.beginPath();
    for (const [x, y] of hits) {
      context.moveTo(pose.map[0], pose.map[1]);
      context.lineTo(x, y);
    }
    context.stroke();
    context.fillStyle = colours.drone;
    for (const [x, y] of hits) {
      context.beginPath();
      context.arc(x, y, 3 / transform.scale_px, 0, 2 * Math.PI);
      context.fill();
    }
  }

  drawDrone({context, transform, colours, at_us}) {
    const pose = this.model.poseAt(at_us);
    if (pose === null) return;
    this.drawEllipse(context, colours, pose, 1 / transform.scale_px);
    context.save();
    context.translate(pose.map[0], pose.map[1]);
    context.rotate(pose.map[2]);
    context.scale(1 / transform.scale_px, 1 / transform.scale_px);
    context.beginPath();
    for (const [x, y] of [[15, 0], [-10, 9], [-5, 0], [-10, -9]]) context.lineTo(x, y);
    context.closePath();
    context.fillStyle = colours.drone;
    context.strokeStyle = colours.halo;
    context.lineWidth = 3;
    context.stroke();
    context.fill();
    context.restore();
  }

  /// Where the drone is with 95 %.
  drawEllipse(context, colours, pose, pixel_m) {
    const [xx, xy, , yy] = pose.covariance;
    if (!(xx + yy > 0)) return;  // zero: not known yet
    const middle = (xx + yy) / 2;
    const apart = Math.hypot((xx - yy) / 2, xy);
    const axes_m = [middle + apart, middle - apart].map((variance) => ELLIPSE_SIGMAS * Math.sqrt(Math.max(0, variance)));
    context.beginPath();
    context.ellipse(pose.map[0], pose.map[1], axes_m[0], axes_m[1], Math.atan2(2 * xy, xx - yy) / 2, 0, 2 * Math.PI);
    context.fillStyle = colours.uncertain;
    context.fill();
    context.strokeStyle = colours.drone;
    context.lineWidth = pixel_m;
    context.stroke();
  }

  drawScaleBar({context, transform, colours}) {
    const length_m = gridStep_m(SCALE_BAR_px / transform.scale_px / 2.5);
    const [width, x, y] = [length_m * transform.scale_px, 16, transform.size[1] - 16];
    for (const [colour, line] of [[colours.halo, 5], [colours.text, 2]]) {
      context.strokeStyle = colour;
      context.lineWidth = line;
      context.beginPath();
      for (const [px, py] of [[x, y - 6], [x, y], [x + width, y], [x + width, y - 6]]) context.lineTo(px, py);
      context.stroke();
    }
    label(context, colours, lengthText(length_m, length_m) + " m", x + width / 2, y - 8, "center");
  }

  drawMeasure({context, transform, colours, measure}) {
    const points = measure.points.map((point) => transform.toScreen(point));
    for (const point of points) ring(context, colours.measure, point, 4, 2);
    if (points.length < 2) return;
    strokeLine(context, colours.measure, 2, [...points[0], ...points[1]]);
    const [[x0, y0], [x1, y1]] = measure.points;
    const text = `${Math.hypot(x1 - x0, y1 - y0).toFixed(2)} m`;
    context.font = "600 13px system-ui, sans-serif";
    label(context, {...colours, text: colours.measure}, text, (points[0][0] + points[1][0]) / 2, (points[0][1] + points[1][1]) / 2 - 10, "center", context.font);
  }
}

/// Of a line of that width in pixels.
function width_m(width_px, {scale_px}) {
  return width_px * Math.min(1, Math.max(0.5, scale_px / FULL_SCALE_px)) / scale_px;
}

function strokeLine(context, colour, width, [x0, y0, x1, y1]) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

function ring(context, colour, [x, y], radius, width) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.stroke();
}

function label(context, colours, text, x, y, align, font = FONT) {
  context.font = font;
  context.textAlign = align;
  context.lineJoin = "round";
  context.strokeStyle = colours.halo;
  context.lineWidth = 3;
  context.strokeText(text, x, y);
  context.fillStyle = colours.text;
  context.fillText(text, x, y);
}

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

const MIN_SCALE_PX = 0.2;
const MAX_SCALE_PX = 2000;

/// From metres in frame map (y up) to CSS pixels on the canvas (y down).
export class ViewTransform {
  constructor() {
    this.center = [0, 0];  // m, in the middle of the canvas
    this.scale_px = 40;    // a metre
    this.up_rad = Math.PI / 2;  // the direction that points up; pi/2: the map's y
    this.size = [1, 1];    // px
  }

  get turn_rad() {
    return this.up_rad - Math.PI / 2;
  }

  toScreen([x_m, y_m]) {
    const [dx, dy] = [x_m - this.center[0], y_m - this.center[1]];
    const [c, s] = [Math.cos(this.turn_rad), Math.sin(this.turn_rad)];
    return [this.size[0] / 2 + (c * dx + s * dy) * this.scale_px, this.size[1] / 2 - (c * dy - s * dx) * this.scale_px];
  }

  toMap([x_px, y_px]) {
    const [u, v] = [(x_px - this.size[0] / 2) / this.scale_px, (this.size[1] / 2 - y_px) / this.scale_px];
    const [c, s] = [Math.cos(this.turn_rad), Math.sin(this.turn_rad)];
    return [this.center[0] + c * u - s * v, this.center[1] + s * u + c * v];
  }

  /// So that the context draws in metres.
  apply(context, pixelRatio) {
    const [c, s] = [Math.cos(this.turn_rad) * this.scale_px, Math.sin(this.turn_rad) * this.scale_px];
    const [x, y] = this.center;
    const [e, f] = [this.size[0] / 2 - c * x - s * y, this.size[1] / 2 - s * x + c * y];
    context.setTransform(c * pixelRatio, s * pixelRatio, s * pixelRatio, -c * pixelRatio, e * pixelRatio, f * pixelRatio);
  }

  pan(dx_px, dy_px) {
    const from = this.toMap([0, 0]);
    const to = this.toMap([dx_px, dy_px]);
    this.center = [this.center[0] - to[0] + from[0], this.center[1] - to[1] + from[1]];
  }

  /// The point under the pixel stays there.
  zoom(factor, at_px) {
    const before = this.toMap(at_px);
    this.scale_px = Math.min(MAX_SCALE_PX, Math.max(MIN_SCALE_PX, this.scale_px * factor));
    const after = this.toMap(at_px);
    this.center = [this.center[0] + before[0] - after[0], this.center[1] + before[1] - after[1]];
  }

  /// bounds: {low: [x, y], high: [x, y]}; free_px: what lies over the canvas at left, top, right, bottom.
  fit(bounds, free_px) {
    const [left, top, right, bottom] = free_px;
    const [width_px, height_px] = [this.size[0] - left - right, this.size[1] - top - bottom];
    const width_m = Math.max(1, bounds.high[0] - bounds.low[0]);
    const height_m = Math.max(1, bounds.high[1] - bounds.low[1]);
    this.scale_px = Math.min(400, Math.max(MIN_SCALE_PX, Math.min(width_px / width_m, height_px / height_m)));
    this.up_rad = Math.PI / 2;
    this.center = [(bounds.low[0] + bounds.high[0]) / 2 - (left - right) / 2 / this.scale_px,
                   (bounds.low[1] + bounds.high[1]) / 2 + (top - bottom) / 2 / this.scale_px];
  }
}

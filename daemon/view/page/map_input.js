// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

const ZOOM_STEP = 1.3;
const WHEEL_STEP = 0.0016;   // of a factor's logarithm, a pixel of the wheel
const PAN_STEP_px = 60;
const CLICK_WITHIN_px = 5;

/// Pan and zoom of the map by mouse, touch and keyboard. `on`: moved(isPan), clicked(point_px), hovered(point_px or null).
export class MapInput {
  constructor(canvas, transform, on) {
    Object.assign(this, {canvas, transform, on});
    this.pointers = new Map();
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const type of ["pointerup", "pointercancel"]) canvas.addEventListener(type, (event) => this.up(event));
    canvas.addEventListener("pointerleave", () => this.on.hovered(null));
    canvas.addEventListener("wheel", (event) => this.wheel(event), {passive: false});
    canvas.addEventListener("dblclick", (event) => this.zoom(2, pointOf(event)));
  }

  down(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, pointOf(event));
    this.moved_px = this.pointers.size > 1 ? Infinity : 0;
  }

  move(event) {
    const [from, to] = [this.pointers.get(event.pointerId), pointOf(event)];
    this.on.hovered(to);
    if (!from) return;
    const others = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, point]) => point);
    this.pointers.set(event.pointerId, to);
    if (others.length === 1) this.pinch(others[0], from, to);
    else if (others.length === 0) this.drag(from, to);
  }

  drag(from, to) {
    this.moved_px += Math.hypot(to[0] - from[0], to[1] - from[1]);
    if (this.moved_px < CLICK_WITHIN_px) return;
    this.transform.pan(to[0] - from[0], to[1] - from[1]);
    this.on.moved(true);
  }

  pinch(fixed, from, to) {
    const apart = (point) => Math.max(1, Math.hypot(point[0] - fixed[0], point[1] - fixed[1]));
    this.transform.pan((to[0] - from[0]) / 2, (to[1] - from[1]) / 2);
    this.zoom(apart(to) / apart(from), [(to[0] + fixed[0]) / 2, (to[1] + fixed[1]) / 2]);
  }

  up(event) {
    const isClick = this.pointers.delete(event.pointerId) && this.moved_px < CLICK_WITHIN_px && event.type === "pointerup";
    if (isClick) this.on.clicked(pointOf(event));
  }

  wheel(event) {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
    this.zoom(Math.exp(-event.deltaY * lines * WHEEL_STEP), pointOf(event));
  }

  zoom(factor, at_px = this.transform.size.map((side) => side / 2)) {
    this.transform.zoom(factor, at_px);
    this.on.moved(false);
  }

  closer() {
    this.zoom(ZOOM_STEP);
  }

  farther() {
    this.zoom(1 / ZOOM_STEP);
  }

  /// The map's content moves against the arrow.
  panByArrow(key) {
    const [dx, dy] = {ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[key];
    this.transform.pan(dx * PAN_STEP_px, dy * PAN_STEP_px);
    this.on.moved(true);
  }
}

function pointOf(event) {
  const box = event.currentTarget.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

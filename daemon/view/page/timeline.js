// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

import {durationText} from "./units.js";

const RATES = [0.25, 0.5, 1, 2, 5, 10, 20, 50];
const PLAY_PATH = "M4 2.5v11L13 8z";
const PAUSE_PATH = "M4 2.5h3v11H4zM9.5 2.5h3v11h-3z";

/// The time line under the map: where in the run the page is, and buttons to move there.
export class Timeline {
  constructor(root, model, player) {
    Object.assign(this, {root, model, player});
    this.canvas = root.querySelector("#track-canvas");
    this.track = root.querySelector("#track");
    this.shown = "";
    this.connectButtons();
    this.connectTrack();
  }

  connectButtons() {
    const on = (id, act) => this.root.querySelector(id).addEventListener("click", act);
    on("#play", () => this.player.togglePlay());
    on("#step-back", () => this.player.step(-1));
    on("#step-on", () => this.player.step(1));
    on("#live", () => this.player.goLive());
    this.rates = this.root.querySelector("#rate");
    this.rates.addEventListener("change", () => this.player.rate = Number(this.rates.value));
  }

  connectTrack() {
    const seek = (event) => {
      const box = this.track.getBoundingClientRect();
      const share = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
      this.player.seek(this.model.first_us + share * (this.model.newest_us - this.model.first_us));
    };
    this.track.addEventListener("pointerdown", (event) => {
      this.track.setPointerCapture(event.pointerId);
      seek(event);
    });
    this.track.addEventListener("pointermove", (event) => this.track.hasPointerCapture(event.pointerId) && seek(event));
    this.track.addEventListener("keydown", (event) => {
      const seconds = {ArrowLeft: -5, ArrowRight: 5, PageUp: 30, PageDown: -30}[event.key];
      if (seconds === undefined) return;
      this.player.skip(seconds);
      event.preventDefault();
      event.stopPropagation();
    });
  }

  showRates() {
    const rates = [...new Set([...RATES, this.player.rate])].sort((a, b) => a - b);
    this.rates.replaceChildren(...rates.map((rate) => new Option(`${rate}×`, rate)));
    this.rates.value = String(this.player.rate);
  }

  update(colours) {
    const [first_us, newest_us] = [this.model.first_us, this.model.newest_us];
    const at_us = this.player.at_us ?? newest_us;
    const [at_s, length_s] = [(at_us - first_us) / 1e6, (newest_us - first_us) / 1e6];
    const state = [at_s, length_s, this.player.isPlaying, this.player.at_us === null, this.model.events.length, this.track.clientWidth, colours.text].join();
    if (state === this.shown) return;
    this.shown = state;
    this.showTexts(Math.max(0, at_s), length_s);
    this.drawTrack(colours, length_s > 0 ? at_s / length_s : 1);
  }

  showTexts(at_s, length_s) {
    this.root.querySelector("#clock").value = durationText(at_s, true);
    this.root.querySelector("#length").value = durationText(length_s);
    this.root.querySelector("#play-icon").setAttribute("d", this.player.isPlaying ? PAUSE_PATH : PLAY_PATH);
    this.root.querySelector("#live").dataset.on = this.player.at_us === null;
    this.track.setAttribute("aria-valuenow", at_s.toFixed(1));
    this.track.setAttribute("aria-valuemax", length_s.toFixed(1));
    this.track.setAttribute("aria-valuetext", durationText(at_s));
  }

  drawTrack(colours, share) {
    const [width, height] = [this.track.clientWidth, this.track.clientHeight];
    const ratio = devicePixelRatio;
    this.canvas.width = width * ratio;
    this.canvas.height = height * ratio;
    const context = this.canvas.getContext("2d");
    context.scale(ratio, ratio);
    context.fillStyle = colours.axis;
    context.fillRect(0, height / 2 - 2, width, 4);
    context.fillStyle = colours.trail;
    context.fillRect(0, height / 2 - 2, width * share, 4);
    this.drawEvents(context, colours, width, height);
    context.fillStyle = colours.drone;
    context.beginPath();
    context.arc(Math.min(width - 6, Math.max(6, width * share)), height / 2, 6, 0, 2 * Math.PI);
    context.fill();
  }

  drawEvents(context, colours, width, height) {
    const length_us = Math.max(1, this.model.newest_us - this.model.first_us);
    const shades = [colours.axis, colours.closure, colours.raw, colours.drone];
    const reaches_px = [4, 4, 8, 10];
    context.globalAlpha = 0.6;
    for (const event of this.model.events) {
      const x_px = (event.utime_us - this.model.first_us) / length_us * (width - 2);
      context.fillStyle = shades[event.level];
      context.fillRect(x_px, height / 2 - reaches_px[event.level], 1, 2 * reaches_px[event.level]);
    }
    context.globalAlpha = 1;
  }
}

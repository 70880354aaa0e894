// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// Colours of what is drawn on the canvas; those of the page around it stand in style.css.

import {readStored, store} from "./storage.js";

const LIGHT = {
  paper: [255, 255, 255], ink: [26, 32, 40], unknown: "#e4e8ec", grid: "#00183014", axis: "#00183040",
  trail: "#2366c8", later: "#2366c838", raw: "#b3702e", wall: "#0a8f6a", closure: "#c02a8a", drone: "#e0531f", beam: "#e0531fa0",
  waiting: "#c9431280", uncertain: "#e0531f30", text: "#26313c", halo: "#ffffffd0", measure: "#8a1fd0",
};
const DARK = {
  paper: [44, 52, 62], ink: [236, 240, 244], unknown: "#14181d", grid: "#ffffff0d", axis: "#ffffff38",
  trail: "#5fa8ff", later: "#5fa8ff38", raw: "#d9964a", wall: "#35c795", closure: "#ff6bc4", drone: "#ff8a4c", beam: "#ff8a4ca0",
  waiting: "#ffa06a90", uncertain: "#ff8a4c38", text: "#c8d2dc", halo: "#14181dd0", measure: "#c78bff",
};
const STORED = "swiftlet-theme";
const THEMES = ["light", "dark"];

/// The theme: the system's until the user chooses.
export class Theme {
  constructor(onChange) {
    this.chosen = readStored(STORED);
    this.query = matchMedia("(prefers-color-scheme: dark)");
    this.onChange = onChange;
    this.query.addEventListener("change", () => this.apply());
    this.apply();
  }

  get name() {
    if (THEMES.includes(this.chosen)) return this.chosen;
    return this.query.matches ? "dark" : "light";
  }

  get colours() {
    return this.name === "dark" ? DARK : LIGHT;
  }

  toggle() {
    this.chosen = this.name === "dark" ? "light" : "dark";
    store(STORED, this.chosen);
    this.apply();
  }

  apply() {
    document.documentElement.dataset.theme = this.name;
    this.onChange(this);
  }
}

export const PRINT_COLOURS = LIGHT;

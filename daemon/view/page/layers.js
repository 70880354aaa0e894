// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

import {readStored, store} from "./storage.js";

const STORED = "swiftlet-layers";
const LAYERS = [
  ["map", "Map", true], ["grid", "Grid and axes", true], ["trail", "Trail, corrected", true],
  ["raw", "Trail, dead reckoning", false], ["walls", "Walls", true], ["closures", "Loop closures", true],
  ["drone", "Drone", true], ["beams", "Beams", true], ["waiting", "Not in the map yet", true],
];

/// Which layers are shown, as the user left them: names to booleans.
export function storedLayers() {
  let stored = {};
  try {
    stored = JSON.parse(readStored(STORED)) ?? {};
  } catch {  // not ours
  }
  return Object.fromEntries(LAYERS.map(([name, , isOn]) => [name, typeof stored[name] === "boolean" ? stored[name] : isOn]));
}

/// A box to tick for each layer; keys 1 to 9 tick them, too.
export class LayerBoxes {
  constructor(root, layers, onChange) {
    Object.assign(this, {layers, onChange});
    this.boxes = LAYERS.map(([name, text], i) => this.addBox(root, name, text, i + 1));
  }

  addBox(root, name, text, key) {
    const [label, box, hint] = ["label", "input", "kbd"].map((tag) => document.createElement(tag));
    box.type = "checkbox";
    box.id = `layer-${name}`;
    box.checked = this.layers[name];
    box.addEventListener("change", () => this.set(name, box.checked));
    hint.textContent = key;
    label.dataset.layer = name;
    label.append(box, text, hint);
    root.append(label);
    return box;
  }

  set(name, isOn) {
    this.layers[name] = isOn;
    store(STORED, JSON.stringify(this.layers));
    this.onChange();
  }

  toggle(number) {
    this.boxes[number - 1]?.click();
  }
}

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

import {durationText} from "./units.js";

const LEVELS = ["note", "good", "warning", "bad"];
const MOST_LINES = 400;

/// The log of events in words, newest first; a click goes to the moment.
export class EventLog {
  constructor(list, model, onSeek) {
    Object.assign(this, {list, model, onSeek});
    this.count = 0;
  }

  clear() {
    this.list.replaceChildren();
    this.count = 0;
  }

  update() {
    for (const event of this.model.events.slice(this.count)) this.list.prepend(this.line(event));
    this.count = this.model.events.length;
    while (this.list.childElementCount > MOST_LINES) this.list.lastElementChild.remove();
  }

  line(event) {
    const [line, button, time] = ["li", "button", "time"].map((tag) => document.createElement(tag));
    time.textContent = durationText((event.utime_us - this.model.first_us) / 1e6);
    button.append(time, event.text);
    button.addEventListener("click", () => this.onSeek(event.utime_us));
    line.dataset.level = LEVELS[event.level] ?? "note";
    line.append(button);
    return line;
  }
}

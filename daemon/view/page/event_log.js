// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

import {durationText} from "./units.js";

const LEVELS = ["note", "good", "warning", "bad"];
const MOST_LINES = 400;

/// The log of events in words, newest first; a click goes to the moment. What came after the moment that is looked at is
/// faint, and what came last before it is scrolled to, unless the pointer is there.
export class EventLog {
  constructor(list, model, onSeek) {
    Object.assign(this, {list, model, onSeek});
    this.count = 0;
    this.newestLine = null;  // of those that are not faint
  }

  clear() {
    this.list.replaceChildren();
    this.count = 0;
    this.newestLine = null;
  }

  update(at_us) {
    for (const event of this.model.events.slice(this.count)) this.list.prepend(this.line(event));
    this.count = this.model.events.length;
    while (this.list.childElementCount > MOST_LINES) this.list.lastElementChild.remove();
    this.fade(at_us);
  }

  fade(at_us) {
    const lines = [...this.list.children];
    for (const line of lines) line.classList.toggle("later", at_us !== null && Number(line.dataset.utime_us) > at_us);
    const newest = lines.find((line) => !line.classList.contains("later")) ?? null;
    if (newest === this.newestLine) return;
    this.newestLine = newest;
    if (at_us !== null && newest !== null && !this.list.matches(":hover")) this.list.scrollTop = newest.offsetTop - this.list.offsetTop;
  }

  line(event) {
    const [line, button, time] = ["li", "button", "time"].map((tag) => document.createElement(tag));
    time.textContent = durationText((event.utime_us - this.model.first_us) / 1e6);
    button.append(time, event.text);
    button.addEventListener("click", () => this.onSeek(event.utime_us));
    line.dataset.utime_us = event.utime_us;
    line.dataset.level = LEVELS[event.level] ?? "note";
    line.append(button);
    return line;
  }
}

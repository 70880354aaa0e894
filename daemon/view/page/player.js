// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

import {FINISHED} from "./messages.js";

const REQUEST_EVERY_MS = 60;

/// Which moment of the run is looked at: the newest (at_us null) or an earlier one, standing still or playing.
export class Player {
  constructor(model, onRequest) {
    this.model = model;
    this.onRequest = onRequest;  // takes at_us
    this.at_us = null;
    this.isPlaying = true;
    this.rate = 1;
    this.requested_us = undefined;  // nothing yet
    this.requestedAt_ms = 0;
    this.map_id = "";
  }

  /// A run begins, or the same one again on a new connection. The server does not know what is looked at.
  begin(run) {
    this.requested_us = undefined;
    if (run.map_id === this.map_id) return;
    this.map_id = run.map_id;
    this.isPlaying = true;
    this.rate = run.is_recording ? run.rate : 1;
    this.at_us = run.is_recording ? 0 : null;
  }

  /// Goes on by so much of the wall's time. True when the moment has changed.
  advance(elapsed_ms, now_ms) {
    const before_us = this.at_us;
    if (this.at_us !== null && this.model.poses.length > 0) {
      const next_us = Math.max(this.at_us, this.model.first_us) + (this.isPlaying ? elapsed_ms * 1000 * this.rate : 0);
      this.at_us = Math.min(next_us, this.model.newest_us);
    }
    this.request(now_ms);
    return this.at_us !== before_us;
  }

  request(now_ms) {
    if (this.at_us === this.requested_us || now_ms - this.requestedAt_ms < REQUEST_EVERY_MS) return;
    this.requested_us = this.at_us;
    this.requestedAt_ms = now_ms;
    this.onRequest(this.at_us);
  }

  get isAtNewest() {
    return this.at_us === null || this.at_us >= this.model.newest_us;
  }

  seek(at_us) {
    this.at_us = Math.min(Math.max(at_us, this.model.first_us), this.model.newest_us);
  }

  goLive() {
    this.at_us = null;
    this.isPlaying = true;
  }

  togglePlay() {
    if (this.isPlaying) {
      this.at_us ??= this.model.newest_us;
      this.isPlaying = false;
      return;
    }
    if (this.isAtNewest && this.model.status?.state === FINISHED) this.at_us = this.model.first_us;  // again from the start
    this.isPlaying = true;
  }

  /// By so many samples, standing still.
  step(count) {
    if (this.model.poses.length === 0) return;
    this.isPlaying = false;
    const index = this.model.indexAt(this.at_us) + count;
    this.at_us = this.model.poses[Math.min(Math.max(index, 0), this.model.poses.length - 1)].utime_us;
  }

  skip(seconds) {
    this.seek((this.at_us ?? this.model.newest_us) + seconds * 1e6);
  }
}

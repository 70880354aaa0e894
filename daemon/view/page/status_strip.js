// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

import {FINISHED, RUNNING} from "./messages.js";
import {durationText} from "./units.js";

const STATES = ["running", "final pass", "finished"];
const TRACKING = ["good", "uncertain", "lost", "relocalizing"];
const LINK = ["", "connected", "silent", "no device", "no access", "device busy", "device stalls", "device overflows",
  "device mute", "device fault", "device unsuited"];
const LATE_ms = 100;
const BATTERY_LOW_v = 3.2;
const BATTERY_WEAK_v = 3.5;

/// name, value and level ("", "good", "warning", "bad") of each gauge; those without a value are left out.
function gaugesOf(model, at_us) {
  const status = model.status;
  const index = model.indexAt(at_us);
  const pose = model.poses[index];
  return [...runGauges(model, status, pose), ...linkGauges(status), ...mapGauges(model, at_us, index)];
}

function runGauges(model, status, pose) {
  const gauges = [];
  if (status) gauges.push(["State", STATES[status.state] ?? "?", status.state === FINISHED ? "good" : ""]);
  if (model.run.is_recording && status && status.state === RUNNING && status.progress >= 0)
    gauges.push(["Mapped", `${Math.round(status.progress * 100)} %`, ""]);
  if (pose && pose.tracking >= 0)
    gauges.push(["Tracking", TRACKING[pose.tracking] ?? "?", ["good", "warning", "bad", "warning"][pose.tracking] ?? ""]);
  if (pose && model.hasStoreys) gauges.push(["Storey", String(pose.storey), ""]);
  return gauges;
}

function linkGauges(status) {
  if (!status) return [];
  const gauges = [];
  if (status.link_condition > 0) gauges.push(["Link", linkText(status), linkLevel(status)]);
  if (status.battery_v > 0) gauges.push(["Battery", `${status.battery_v.toFixed(2)} V`, batteryLevel(status.battery_v)]);
  if (status.sample_rate_hz > 0 && status.state === RUNNING) gauges.push(["Rate", `${status.sample_rate_hz.toFixed(1)} Hz`, ""]);
  if (status.latency_p99_ms > 0)
    gauges.push(["Latency p99", `${status.latency_p99_ms.toFixed(1)} ms`, status.latency_p99_ms > LATE_ms ? "warning" : ""]);
  if (status.missing_packets > 0) gauges.push(["Missing", String(status.missing_packets), "warning"]);
  if (status.recording > 0) gauges.push(["Recording", recordingText(status), status.recording === 1 ? "good" : "bad"]);
  return gauges;
}

function mapGauges(model, at_us, index) {
  if (index < 0) return [];
  const closures = model.closuresAt(at_us);
  const flown_s = (model.poses[index].utime_us - model.first_us) / 1e6;
  const gauges = [["Time", durationText(flown_s), ""], ["Flown", `${model.poses[index].travel_m.toFixed(0)} m`, ""], ["Loops", String(closures.length), ""]];
  if (closures.length === 0) return gauges;
  const newest_us = Math.max(...closures.map((closure) => closure.found_us));
  const since_m = model.poses[index].travel_m - (model.poseAt(newest_us)?.travel_m ?? 0);
  return [...gauges, ["Since loop", `${since_m.toFixed(0)} m`, ""]];
}

function linkText(status) {
  const name = LINK[status.link_condition] ?? "?";
  if (status.link_condition !== 1) return name;
  const parts = [status.ack_rate >= 0 ? `${Math.round(status.ack_rate * 100)} %` : name];
  if (status.rssi_dbm !== 0) parts.push(`${status.rssi_dbm} dBm`);
  return parts.join(" · ");
}

function linkLevel(status) {
  if (status.link_condition !== 1) return "bad";
  return status.ack_rate >= 0 && status.ack_rate < 0.7 ? "warning" : "good";
}

function recordingText(status) {
  return status.recording === 1 ? `${(status.recorded_bytes / 1e6).toFixed(1)} MB` : "failed";
}

function batteryLevel(battery_v) {
  if (battery_v < BATTERY_LOW_v) return "bad";
  return battery_v < BATTERY_WEAK_v ? "warning" : "";
}

/// Shows the gauges in a <dl>; touches the page only where something has changed.
export class StatusStrip {
  constructor(list) {
    this.list = list;
    this.shown = "";
  }

  update(model, at_us) {
    const gauges = gaugesOf(model, at_us);
    const text = JSON.stringify(gauges);
    if (text === this.shown) return;
    this.shown = text;
    this.list.replaceChildren(...gauges.map(gaugeElement));
  }
}

function gaugeElement([name, value, level]) {
  const [gauge, term, description] = ["div", "dt", "dd"].map((tag) => document.createElement(tag));
  term.textContent = name;
  description.textContent = value;
  description.dataset.level = level;
  gauge.append(term, description);
  return gauge;
}

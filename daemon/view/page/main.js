// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// Puts the parts of the page together.

import {boundsWith} from "./bounds.js";
import {Connection} from "./connection.js";
import {EventLog} from "./event_log.js";
import {connectKeys} from "./keys.js";
import {LayerBoxes, storedLayers} from "./layers.js";
import {MapInput} from "./map_input.js";
import {FINISHED} from "./messages.js";
import {Player} from "./player.js";
import {RunModel} from "./run_model.js";
import {SaveButtons} from "./save_buttons.js";
import {Scene} from "./scene.js";
import {StatusStrip} from "./status_strip.js";
import {Theme} from "./theme.js";
import {TileMap} from "./tile_map.js";
import {Timeline} from "./timeline.js";
import {ViewTransform} from "./view_transform.js";

const SILENT_AFTER_ms = 4000;
const SILENT_AFTER_PERIODS = 2;  // of status messages: where nothing is flown no other come
const NARROW_px = 760;
const FREE_px = [48, 28, 60, 48];  // left, top, right, bottom: what lies over the map
const byId = (id) => document.getElementById(id);

class Page {
  constructor() {
    this.canvas = byId("map");
    this.context = this.canvas.getContext("2d", {alpha: false});
    this.transform = new ViewTransform();
    this.model = new RunModel();
    this.layers = storedLayers();
    this.theme = new Theme((theme) => this.setColours(theme.colours));
    this.tileMap = new TileMap(this.theme.colours);
    this.scene = new Scene(this.model, this.tileMap, this.layers);
    this.player = new Player(this.model, (at_us) => this.connection.lookAt(at_us));
    this.timeline = new Timeline(byId("timeline"), this.model, this.player);
    this.strip = new StatusStrip(byId("gauges"));
    this.log = new EventLog(byId("log"), this.model, (at_us) => this.player.seek(at_us));
    this.boxes = new LayerBoxes(byId("layers"), this.layers, () => this.redraw());
    this.save = new SaveButtons(byId("save"), this);
    this.input = new MapInput(this.canvas, this.transform, {
      moved: (isPan) => this.onMoved(isPan),
      clicked: (point_px) => this.onClicked(point_px),
      hovered: (point_px) => this.onHovered(point_px),
    });
    this.isFitted = true;     // until the user moves the map
    this.isFollowing = false;
    this.isHeadingUp = false;
    this.measure = null;      // {points} while measuring
    this.isConnected = false;
    this.lastMessage_ms = 0;
    this.lastStatus_ms = 0;
    this.statusPeriod_ms = 0;  // between the newest two of a run
    this.frames = 0;          // drawn so far
    this.isSynced = false;
    this.hasEnded = false;    // swiftletd has, whatever moment is looked at
    this.isFinal = false;     // the map that was last whole
    this.connectButtons();
    connectKeys(this);
    new ResizeObserver(() => this.resize()).observe(byId("stage"));
    this.resize();
    this.connection = new Connection((message) => this.onMessage(message), (isThere) => this.onConnection(isThere));
    this.lastFrame_ms = performance.now();
    requestAnimationFrame((now_ms) => this.frame(now_ms));
  }

  connectButtons() {
    const on = (id, act) => byId(id).addEventListener("click", act);
    on("zoom-in", () => this.input.closer());
    on("zoom-out", () => this.input.farther());
    on("fit", () => this.fit());
    on("follow", () => this.toggleFollow());
    on("heading-up", () => this.toggleHeadingUp());
    on("measure", () => this.toggleMeasure());
    on("theme", () => this.theme.toggle());
    on("panel-toggle", () => this.togglePanel());
    if (innerWidth < NARROW_px) this.togglePanel();
  }

  onMessage(message) {
    this.lastMessage_ms = performance.now();
    this.isSynced = message.type === "synced";
    const handlers = {
      run: () => this.beginRun(message),
      status: () => this.takeStatus(message),
      poses: () => this.model.addPoses(message.poses, message.bearings),
      walls: () => this.model.walls = message.walls,
      closures: () => this.model.addClosures(message.closures),
      events: () => this.model.events.push(...message.events),
      storey: () => this.showStorey(message.storey),
      tiles: () => this.addTiles(message),
      synced: () => this.onSynced(message),
    };
    handlers[message.type]?.();
    this.redraw();
  }

  takeStatus(status) {
    const now_ms = performance.now();
    this.statusPeriod_ms = this.model.status ? now_ms - this.lastStatus_ms : 0;
    this.lastStatus_ms = now_ms;
    this.model.status = status;
  }

  beginRun(run) {
    const isSame = run.map_id === this.model.run.map_id;
    this.model.begin(run);
    this.tileMap.clear();
    this.log.clear();
    this.player.begin(run);
    this.timeline.showRates();
    byId("title").textContent = titleOf(run);
    document.title = `${titleOf(run)} – swiftlet`;
    if (isSame) return;
    this.hasEnded = false;
    this.isFitted = !this.isFollowing;
  }

  showStorey(storey) {
    this.model.storey = storey;
    this.model.walls = [];
    this.tileMap.clear();
  }

  addTiles(message) {
    this.model.resolution_m = message.resolution_m;
    for (const tile of message.tiles) this.tileMap.set(tile);
  }

  /// When swiftletd ends, its server may, too: who looks back goes to the newest while it can be had.
  onSynced({utime_us, has_ended}) {
    if (this.model.run.is_recording) return;
    const isNews = has_ended && !this.hasEnded;
    this.hasEnded = has_ended;
    this.isFinal = has_ended && utime_us === 0;
    if (!isNews || this.isFinal) return;
    this.player.goLive();
    this.player.request(performance.now());
  }

  onConnection(isThere) {
    this.isConnected = isThere;
    if (isThere) this.lastMessage_ms = performance.now();
    this.redraw();
  }

  onMoved(isPan) {
    this.isFitted = false;
    if (isPan) this.setFollowing(false);
    this.redraw();
  }

  onClicked(point_px) {
    if (!this.measure) return;
    const points = this.measure.points.length >= 2 ? [] : this.measure.points;
    this.measure.points = [...points, this.transform.toMap(point_px)];
    this.redraw();
  }

  onHovered(point_px) {
    byId("readout").textContent = point_px === null ? "" : this.placeText(this.transform.toMap(point_px));
  }

  placeText(point) {
    const place = point.map((part) => part.toFixed(2).replace("-", "−")).join(", ");
    const percent = this.model.resolution_m > 0 ? this.tileMap.percentAt(point, this.model.resolution_m) : -1;
    return percent < 0 ? `${place} m` : `${place} m · ${percent} % occupied`;
  }

  fit() {
    this.setFollowing(false);
    this.setHeadingUp(false);
    this.isFitted = true;
    this.redraw();
  }

  toggleFollow() {
    this.setFollowing(!this.isFollowing);
  }

  setFollowing(isFollowing) {
    this.isFollowing = isFollowing;
    if (isFollowing) this.isFitted = false;
    byId("follow").setAttribute("aria-pressed", isFollowing);
    this.redraw();
  }

  toggleHeadingUp() {
    this.setHeadingUp(!this.isHeadingUp);
    if (this.isHeadingUp) this.setFollowing(true);
  }

  setHeadingUp(isHeadingUp) {
    this.isHeadingUp = isHeadingUp;
    if (!isHeadingUp) this.transform.up_rad = Math.PI / 2;
    byId("heading-up").setAttribute("aria-pressed", isHeadingUp);
    this.redraw();
  }

  toggleMeasure() {
    this.measure = this.measure ? null : {points: []};
    byId("measure").setAttribute("aria-pressed", this.measure !== null);
    this.canvas.dataset.measuring = this.measure !== null;
    this.redraw();
  }

  togglePanel() {
    const isOpen = document.body.classList.toggle("panel-closed") === false;
    byId("panel-toggle").setAttribute("aria-expanded", isOpen);
  }

  setColours(colours) {
    this.tileMap?.setColours(colours);
    this.redraw();
  }

  resize() {
    const box = byId("stage").getBoundingClientRect();
    this.transform.size = [Math.max(1, box.width), Math.max(1, box.height)];
    this.pixelRatio = devicePixelRatio;
    this.canvas.width = this.transform.size[0] * this.pixelRatio;
    this.canvas.height = this.transform.size[1] * this.pixelRatio;
    this.redraw();
  }

  redraw() {
    this.isStale = true;
  }

  frame(now_ms) {
    requestAnimationFrame((next_ms) => this.frame(next_ms));  // first: an error costs one frame
    const hasMoved = this.player.advance(now_ms - this.lastFrame_ms, now_ms);
    this.lastFrame_ms = now_ms;
    this.showNotice();
    if (this.pixelRatio !== devicePixelRatio) this.resize();  // on another screen
    if (this.isStale || hasMoved) this.draw();
  }

  draw() {
    this.isStale = false;
    this.frames += 1;
    this.placeView();
    this.scene.draw({
      context: this.context, transform: this.transform, colours: this.theme.colours, pixelRatio: this.pixelRatio,
      at_us: this.player.at_us, measure: this.measure,
    });
    this.strip.update(this.model, this.player.at_us);
    this.timeline.update(this.theme.colours);
    this.log.update(this.player.at_us);
  }

  placeView() {
    const pose = this.model.poseAt(this.player.at_us);
    if (this.isFollowing && pose) this.transform.center = pose.map.slice(0, 2);
    if (this.isHeadingUp && pose) this.transform.up_rad = pose.map[2];
    if (!this.isFitted) return;
    const map = this.tileMap.bounds(this.model.resolution_m);
    const bounds = this.scene.placesToSee(this.player.at_us).reduce(boundsWith, map);
    if (bounds) this.transform.fit(bounds, FREE_px);
  }

  showNotice() {
    const [state, text] = this.connectionState();
    const dot = byId("connection");
    if (dot.dataset.state === state) return;
    dot.dataset.state = state;
    dot.setAttribute("aria-label", text || "connected");
    byId("notice").textContent = text;
  }

  connectionState() {
    const isLive = !this.model.run.is_recording;
    const hasEnded = isLive && (this.hasEnded || this.model.status?.state === FINISHED);
    if (!this.isConnected && hasEnded)
      return ["lost", `swiftletd has ended: the map is ${this.isFinal && this.isSynced ? "" : "not "}final`];
    if (!this.isConnected) return ["lost", "Connection lost: trying again"];
    if (this.model.run.generation === 0) return ["waiting", "Waiting for swiftletd"];
    if (isLive && !hasEnded && this.isSilent()) return ["silent", "swiftletd is silent"];
    return ["there", ""];
  }

  isSilent() {
    const patience_ms = Math.max(SILENT_AFTER_ms, SILENT_AFTER_PERIODS * this.statusPeriod_ms);
    return performance.now() - this.lastMessage_ms > patience_ms;
  }
}

function titleOf(run) {
  return run.is_recording ? run.title.split("/").pop() : "swiftlet live";
}

window.swiftletPage = new Page();

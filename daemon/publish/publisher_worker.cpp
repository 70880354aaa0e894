// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/publisher_worker.hpp"

#include <algorithm>
#include <utility>

#include "daemon/publish/status_log.hpp"

namespace swiftlet {
namespace {

LinkRates link_rates(const LinkStatistics& before, const LinkStatistics& now, double elapsed_s) {
  LinkRates rates;
  const auto sent = static_cast<double>(now.packets_sent - before.packets_sent);
  if (sent > 0.0) {
    rates.ack_rate = static_cast<double>(now.packets_acked - before.packets_acked) / sent;
    rates.retries_per_packet = static_cast<double>(now.radio_retries - before.radio_retries) / sent;
  }
  if (elapsed_s > 0.0) {
    rates.sent_hz = sent / elapsed_s;
    rates.received_hz = static_cast<double>(now.packets_received - before.packets_received) / elapsed_s;
  }
  return rates;
}

}  // namespace

PublisherWorker::PublisherWorker(const PublishConfig& config, double resolution_m,
                                 const PublisherInlet& inlet, Gauges gauges, Publisher& publisher,
                                 const Clock& clock)
    : config_(config),
      resolution_m_(resolution_m),
      inlet_(inlet),
      gauges_(std::move(gauges)),
      publisher_(publisher),
      clock_(clock),
      last_step_(clock.now()),
      last_summary_(last_step_) {}

StepResult PublisherWorker::step() {
  const MonotonicTime now = clock_.now();
  if (is_closing_) return close(now);
  const bool is_last = inlet_.tiles.closed();  // before the look: what came before closing is seen
  publish_poses();
  take_events();
  take_closures();
  take_walls();
  const std::size_t taken = take_tiles();
  refresh_tiles(kTilesPerStep - taken, now);
  last_step_ = now;
  publish_poses();  // tiles take their time
  if (statuses_ == 0 || now - last_summary_ >= from_seconds(config_.status_period_s)) publish_summary(now);
  if (is_last && taken == 0) {
    is_closing_ = true;
    final_tiles_left_ = tiles_.size();
    last_refreshed_ = {};
  }
  return StepResult::kIdle;
}

void PublisherWorker::publish_poses() {
  PoseUpdate pose;
  while (inlet_.poses.try_pop(pose)) {
    now_ = pose.stamp;
    ++poses_since_summary_;
    publisher_.publish_pose(pose);
    gauges_.pose_latency.record(clock_.now() - pose.arrived_at);
  }
}

void PublisherWorker::take_events() {
  VehicleEvent event;
  while (inlet_.events.try_pop(event)) {
    log_event(event);
    if (is_warning(event)) publisher_.publish_event(now_, event);
  }
}

void PublisherWorker::take_walls() {
  WallInMap wall;
  while (inlet_.walls.try_pop(wall)) {
    if (wall.is_gone) {
      walls_.erase(wall.id);
    } else {
      walls_.insert_or_assign(wall.id, wall);
    }
  }
}

void PublisherWorker::take_closures() {
  ClosureUpdate closure;
  while (inlet_.closures.try_pop(closure)) {
    log_closure(closure);
    publisher_.publish_closure(now_, closure);
  }
}

void PublisherWorker::take_counters() {
  static_cast<void>(inlet_.input.load_if_new(status_.input));
  static_cast<void>(inlet_.frontend.load_if_new(status_.frontend));
  static_cast<void>(inlet_.backend.load_if_new(status_.backend));
  static_cast<void>(inlet_.tracking.load_if_new(status_.tracking));
  status_.queues = gauges_.queues();
  status_.stages = gauges_.stages();
  status_.missed_deadlines = gauges_.pose_latency.missed();
  status_.recording = gauges_.recording();
}

std::size_t PublisherWorker::take_tiles() {
  std::size_t taken = 0;
  MapTile tile;
  while (taken < kTilesPerStep && inlet_.tiles.try_pop(tile)) {
    keep(tile);
    publisher_.publish_tile(now_, tile, resolution_m_);
    ++taken;
  }
  return taken;
}

void PublisherWorker::keep(const MapTile& tile) {
  const bool holds_anything = std::any_of(tile.occupancy_percent.begin(), tile.occupancy_percent.end(),
                                          [](std::int8_t percent) { return percent >= 0; });
  KeptTile& kept = tiles_[tile.index];
  version_sum_ += tile.version;
  version_sum_ -= kept.tile.version;  // 0 for a new one
  kept = {tile, holds_anything};
}

void PublisherWorker::refresh_tiles(std::size_t at_most, MonotonicTime now) {
  refresh_due_ +=
      static_cast<double>(tiles_.size()) * to_seconds(now - last_step_) / config_.tile_refresh_period_s;
  // What the pace does not allow is put off, but not piled up beyond one round.
  refresh_due_ = std::min(refresh_due_, static_cast<double>(tiles_.size()));
  for (; at_most > 0 && refresh_due_ >= 1.0; --at_most, refresh_due_ -= 1.0) refresh_next_tile();
}

void PublisherWorker::refresh_next_tile() {
  auto next = tiles_.upper_bound(last_refreshed_);
  if (next == tiles_.end()) next = tiles_.begin();
  last_refreshed_ = next->first;
  publisher_.publish_tile(now_, next->second.tile, resolution_m_);
}

void PublisherWorker::publish_summary(MonotonicTime now) {
  const DaemonStatus before = status_;
  take_counters();
  if (status_.state != DaemonState::kFinished && status_.input.ended) status_.state = DaemonState::kFinishing;
  const double elapsed_s = to_seconds(now - last_summary_);
  status_.link_rates = link_rates(before.input.live.link, status_.input.live.link, elapsed_s);
  if (elapsed_s > 0.0) status_.sample_rate_hz = static_cast<double>(poses_since_summary_) / elapsed_s;
  status_.map = map_summary();
  std::vector<WallInMap> walls;
  walls.reserve(walls_.size());
  for (const auto& [id, wall] : walls_) walls.push_back(wall);
  publisher_.publish_map(now_, status_.map);
  publisher_.publish_walls(now_, walls);
  publisher_.publish_status(now_, status_);
  log_changes(before, status_);
  poses_since_summary_ = 0;
  last_summary_ = now;
  ++statuses_;
}

MapSummary PublisherWorker::map_summary() const {
  MapSummary out{.resolution_m = resolution_m_,
                 .tiles = static_cast<std::uint32_t>(tiles_.size()),
                 .version_sum = version_sum_,
                 .lowest = {},
                 .highest = {}};
  bool is_first = true;
  for (const auto& [index, kept] : tiles_) {
    if (!kept.holds_anything) continue;
    if (std::exchange(is_first, false)) out.lowest = out.highest = index;
    out.lowest = {std::min(out.lowest.x, index.x), std::min(out.lowest.y, index.y)};
    out.highest = {std::max(out.highest.x, index.x), std::max(out.highest.y, index.y)};
  }
  return out;
}

StepResult PublisherWorker::close(MonotonicTime now) {
  for (std::size_t sent = 0; sent < kTilesPerStep && final_tiles_left_ > 0; ++sent, --final_tiles_left_)
    refresh_next_tile();
  if (final_tiles_left_ > 0) return StepResult::kIdle;
  if (final_statuses_left_ == 0) return StepResult::kFinished;
  --final_statuses_left_;
  status_.state = DaemonState::kFinished;
  publish_summary(now);
  return StepResult::kIdle;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/viewer.hpp"

#include <algorithm>
#include <vector>

#include "swiftlet/status_t.hpp"

namespace swiftlet {
namespace {

bool has_ended(const RunHistory& history) {
  const auto* const newest = history.statuses().newest();
  return newest != nullptr && newest->value.state == status_t::STATE_FINISHED;
}

}  // namespace

void Viewer::take(std::string_view text) {
  const std::optional<MomentRequest> request = parse_moment_request(text);
  if (!request) return;
  is_synced_ = is_synced_ && request->at_us == at_us_;
  at_us_ = request->at_us;
}

std::optional<WebMessage> Viewer::next() {
  const std::lock_guard lock(shared_.mutex);
  const RunHistory& history = shared_.history;
  if (history.generation() == 0) return std::nullopt;
  if (sent_.generation != history.generation()) {
    sent_ = Sent{.generation = history.generation()};
    is_synced_ = false;
    at_us_ = source_.is_recording ? std::optional<std::int64_t>(0) : std::nullopt;  // until the page asks
    return run_message(history, source_);
  }
  if (is_synced_ && synced_changes_ == history.changes()) return std::nullopt;
  if (std::optional<WebMessage> message = next_of_run(history)) return message;
  is_synced_ = true;
  synced_changes_ = history.changes();
  return synced_message(at_us_.value_or(0), has_ended(history));
}

std::optional<WebMessage> Viewer::next_of_run(const RunHistory& history) {
  if (auto message = next_status(history)) return message;
  if (auto message = next_poses(history)) return message;
  if (auto message = next_events(history)) return message;
  if (auto message = next_closures(history)) return message;
  if (auto message = next_storey(history)) return message;
  if (auto message = next_walls(history)) return message;
  return next_tiles(history);
}

std::optional<WebMessage> Viewer::next_status(const RunHistory& history) {
  const auto* const entry = looked_at(history.statuses());
  if (entry == nullptr || entry->serial == sent_.status_serial) return std::nullopt;
  sent_.status_serial = entry->serial;
  return status_message(entry->value);
}

std::optional<WebMessage> Viewer::next_poses(const RunHistory& history) {
  std::span<const TrailPose> poses = history.poses_after(sent_.pose_serial);
  if (poses.empty()) return std::nullopt;
  poses = poses.first(std::min(poses.size(), kPosesPerMessage));
  sent_.pose_serial = poses.back().serial;
  return poses_message(poses, history.bearings_rad());
}

std::optional<WebMessage> Viewer::next_events(const RunHistory& history) {
  const std::span<const RunEvent> events = history.events_after(sent_.event_serial);
  if (events.empty()) return std::nullopt;
  sent_.event_serial = events.back().serial;
  return events_message(events);
}

std::optional<WebMessage> Viewer::next_closures(const RunHistory& history) {
  std::vector<SeenClosure> changed;
  std::uint64_t newest_change = sent_.closure_change;
  for (const auto& [index, numbered] : history.closures()) {
    if (numbered.change <= sent_.closure_change) continue;
    changed.push_back(numbered.closure);
    newest_change = std::max(newest_change, numbered.change);
  }
  if (changed.empty()) return std::nullopt;
  sent_.closure_change = newest_change;
  return closures_message(changed);
}

/// The page shows one storey: what it has of another is void.
std::optional<WebMessage> Viewer::next_storey(const RunHistory& history) {
  const StoreyId storey = history.storey_at(at_us_);
  if (storey == sent_.storey) return std::nullopt;
  sent_.storey = storey;
  sent_.walls_serial = 0;
  sent_.tile_versions.clear();
  return storey_message(storey);
}

std::optional<WebMessage> Viewer::next_walls(const RunHistory& history) {
  const auto* const entry = looked_at(history.walls());
  const std::uint32_t serial = entry == nullptr ? 0 : entry->serial;
  if (serial == sent_.walls_serial) return std::nullopt;
  sent_.walls_serial = serial;
  if (entry == nullptr) return walls_message(0, {});
  return walls_message(entry->utime_us, history.walls_at(at_us_, sent_.storey));
}

std::optional<WebMessage> Viewer::next_tiles(const RunHistory& history) {
  std::vector<TileAsOf> changed;
  for (const auto& [index, versions] : history.tiles()) {
    if (index.storey != sent_.storey) continue;
    const auto* const entry = looked_at(versions);
    const std::uint32_t version = entry == nullptr ? 0 : entry->value.version;
    const auto sent = sent_.tile_versions.find(index);
    if ((sent == sent_.tile_versions.end() ? 0 : sent->second) == version) continue;
    sent_.tile_versions[index] = version;
    changed.emplace_back(index, entry == nullptr ? nullptr : &entry->value);
    if (changed.size() == kTilesPerMessage) break;
  }
  if (changed.empty()) return std::nullopt;
  return tiles_message(history.resolution_m(), changed);
}

}  // namespace swiftlet

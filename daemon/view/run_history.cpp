// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/run_history.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

#include "swiftlet/status_t.hpp"

namespace swiftlet {
namespace {

constexpr double kSilenceThatEndsARunS = 5.0;

std::vector<std::uint8_t> deflate_tile(const std::array<std::int8_t, kCellsInTile>& cells) {
  std::array<std::uint8_t, kCellsInTile> bytes;
  std::memcpy(bytes.data(), cells.data(), bytes.size());
  uLongf size = compressBound(bytes.size());
  std::vector<std::uint8_t> deflated(size);
  // Fails for want of memory or room alone; there is room.
  if (compress2(deflated.data(), &size, bytes.data(), bytes.size(), Z_BEST_SPEED) != Z_OK) size = 0;
  deflated.resize(size);
  deflated.shrink_to_fit();
  return deflated;
}

/// Those of `items`, sorted by serial, that come after `serial`.
template <typename Item>
std::span<const Item> after(const std::vector<Item>& items, std::uint32_t serial) {
  const auto first =
      std::upper_bound(items.begin(), items.end(), serial,
                       [](std::uint32_t number, const Item& item) { return number < item.serial; });
  return {first, items.end()};
}

}  // namespace

std::array<std::int8_t, kCellsInTile> inflate_tile(std::span<const std::uint8_t> deflated) {
  std::array<std::uint8_t, kCellsInTile> bytes;
  std::array<std::int8_t, kCellsInTile> cells;
  uLongf size = bytes.size();
  const int outcome = uncompress(bytes.data(), &size, deflated.data(), deflated.size());
  if (outcome == Z_OK && size == bytes.size())
    std::memcpy(cells.data(), bytes.data(), bytes.size());
  else
    cells.fill(-1);
  return cells;
}

bool RunHistory::enter_run(std::int64_t map_id, double silence_s) {
  if (generation_ > 0 && map_id == map_id_) return true;
  if (generation_ > 0 && map_id < map_id_ && silence_s < kSilenceThatEndsARunS) return false;
  begin_run(map_id);
  return true;
}

void RunHistory::begin_run(std::int64_t map_id) {
  const std::uint32_t generation = generation_ + 1;
  const std::uint64_t changes = changes_ + 1;
  *this = RunHistory(limits_);
  generation_ = generation;
  changes_ = changes;
  map_id_ = map_id;
}

/// A message of one of its frames was lost.
void RunHistory::drop_newest_unless_whole() {
  if (poses_.empty() || poses_.back().is_whole()) return;
  ranges_ -= poses_.back().ranges_m.size();
  poses_.pop_back();
}

void RunHistory::add_pose(TrailPose pose) {
  drop_newest_unless_whole();
  pose.serial = ++pose_serial_;
  if (!poses_.empty()) pose.utime_us = std::max(pose.utime_us, poses_.back().utime_us);
  poses_.push_back(std::move(pose));
  ++changes_;
  if (poses_.size() > limits_.poses) thin_poses();
}

void RunHistory::add_local(std::int32_t sequence, const std::array<double, 3>& local) {
  if (poses_.empty() || poses_.back().sequence != sequence) return;
  poses_.back().local = local;
  poses_.back().has_local = true;
  ++changes_;
}

void RunHistory::add_odom(std::int32_t sequence, const std::array<double, 3>& odom) {
  if (poses_.empty() || poses_.back().sequence != sequence) return;
  poses_.back().odom = odom;
  poses_.back().has_odom = true;
  ++changes_;
}

void RunHistory::add_ranges(std::int32_t sequence, const std::vector<float>& bearings_rad,
                            std::vector<float> ranges_m) {
  if (poses_.empty() || poses_.back().sequence != sequence || !poses_.back().ranges_m.empty()) return;
  if (bearings_rad_.empty()) bearings_rad_ = bearings_rad;
  if (bearings_rad != bearings_rad_ || ranges_m.size() != bearings_rad_.size()) return;
  ranges_ += ranges_m.size();
  poses_.back().ranges_m = std::move(ranges_m);
  ++changes_;
  if (ranges_ > limits_.ranges) thin_ranges();
}

StoreyId RunHistory::storey_at(std::optional<std::int64_t> at_us) const {
  auto end = poses_.end();
  if (at_us) end = std::ranges::upper_bound(poses_, *at_us, {}, &TrailPose::utime_us);
  return end == poses_.begin() ? StoreyId{} : make_id<StoreyId>(static_cast<std::size_t>((end - 1)->storey));
}

std::vector<SeenWall> RunHistory::walls_at(std::optional<std::int64_t> at_us, StoreyId storey) const {
  const auto* const entry = at_us ? walls_.at(*at_us) : walls_.newest();
  std::vector<SeenWall> walls;
  if (entry == nullptr) return walls;
  std::ranges::copy_if(entry->value, std::back_inserter(walls), [storey](const SeenWall& wall) {
    return wall.storey == static_cast<std::int8_t>(index_of(storey));
  });
  return walls;
}

bool RunHistory::is_finished_at(std::optional<std::int64_t> at_us) const {
  const auto* const entry = at_us ? statuses_.at(*at_us) : statuses_.newest();
  return entry != nullptr && entry->value.state == status_t::STATE_FINISHED;
}

std::span<const TrailPose> RunHistory::poses_after(std::uint32_t serial) const {
  std::span<const TrailPose> found = after(poses_, serial);
  if (!found.empty() && !found.back().is_whole()) found = found.first(found.size() - 1);
  return found;
}

std::span<const RunEvent> RunHistory::events_after(std::uint32_t serial) const {
  return after(events_, serial);
}

void RunHistory::thin_poses() {
  const std::size_t half = poses_.size() / 2;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < poses_.size(); ++i)
    if (i >= half || i % 2 == 0) {
      if (kept != i) std::swap(poses_[kept], poses_[i]);
      ++kept;
    }
  for (std::size_t i = kept; i < poses_.size(); ++i) ranges_ -= poses_[i].ranges_m.size();
  poses_.resize(kept);
}

/// Of the older half of the poses that have any.
void RunHistory::thin_ranges() {
  const std::size_t goal = ranges_ / 2;
  for (TrailPose& pose : poses_) {
    if (ranges_ <= goal) return;
    ranges_ -= pose.ranges_m.size();
    pose.ranges_m = {};
  }
}

void RunHistory::add_tile(std::int64_t utime_us, const MapTile& tile, double resolution_m) {
  const auto found = tiles_.find(tile.index);
  if (found == tiles_.end() && tiles_.size() >= limits_.tiles) return;
  const auto* const newest = found == tiles_.end() ? nullptr : found->second.newest();
  if (newest != nullptr && newest->value.version >= tile.version) return;
  resolution_m_ = resolution_m;
  StoredTile stored{.version = tile.version, .deflated = deflate_tile(tile.occupancy_percent)};
  tile_bytes_ += stored.deflated.size();
  AsOfList<StoredTile>& versions = tiles_[tile.index];
  if (const StoredTile* replaced = versions.replaceable(utime_us, limits_.tile_spacing_us))
    tile_bytes_ -= replaced->deflated.size();
  versions.append_spaced(utime_us, std::move(stored), limits_.tile_spacing_us);
  ++changes_;
  if (tile_bytes_ > limits_.tile_bytes) thin_tiles();
}

void RunHistory::thin_tiles() {
  for (auto& [index, versions] : tiles_)
    versions.thin([this](const StoredTile& tile) { tile_bytes_ -= tile.deflated.size(); });
}

void RunHistory::add_walls(std::int64_t utime_us, const std::vector<SeenWall>& walls) {
  if (walls_.newest() != nullptr && walls_.newest()->value == walls) return;
  walls_.append(utime_us, walls);
  wall_segments_ += walls.size();
  ++changes_;
  if (wall_segments_ > limits_.wall_segments)
    walls_.thin([this](const std::vector<SeenWall>& forgotten) { wall_segments_ -= forgotten.size(); });
}

void RunHistory::add_closure(const SeenClosure& closure, bool is_dropped, std::int64_t utime_us) {
  const auto found = closures_.find(closure.index);
  if (found == closures_.end() && closures_.size() >= limits_.closures) closures_.erase(closures_.begin());
  NumberedClosure& kept = closures_[closure.index];
  const std::int64_t found_us = found == closures_.end() ? utime_us : kept.closure.found_us;
  kept.closure = closure;
  kept.closure.found_us = found_us;
  kept.closure.dropped_us = is_dropped ? utime_us : 0;
  kept.change = ++changes_;
}

void RunHistory::add_status(const RunStatus& status) {
  statuses_.append(status.utime_us, status);
  ++changes_;
  if (statuses_.size() > limits_.statuses) statuses_.thin([](const RunStatus&) {});
}

void RunHistory::add_event(std::int64_t utime_us, EventLevel level, std::string text) {
  events_.push_back({++event_serial_, utime_us, level, std::move(text)});
  ++changes_;
  if (events_.size() > limits_.events)
    events_.erase(events_.begin(), events_.begin() + static_cast<std::ptrdiff_t>(limits_.events / 2));
}

}  // namespace swiftlet

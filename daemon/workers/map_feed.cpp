// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/map_feed.hpp"

namespace swiftlet {
namespace {

constexpr double kWallMovedM = 0.01;  // smaller moves are not worth a message

bool moved(const Point2& from, const Point2& to) { return distance_m(from, to) > kWallMovedM; }

WallInMap in_map(const Wall& wall, const Backend& backend) {
  const Pose2 T_map_anchor = backend.T_map_keyframe(wall.anchor);
  return {wall.id, T_map_anchor * wall.start_keyframe, T_map_anchor * wall.end_keyframe,
          backend.keyframes().storey(wall.anchor), false};
}

}  // namespace

void MapFeed::note_changes(std::span<const TileIndex> changed_tiles) {
  dirty_tiles_.insert(changed_tiles.begin(), changed_tiles.end());
  walls_pending_ = true;
  closures_pending_ = true;
}

/// Closures pruned before publication are never published.
void MapFeed::prune(const Backend& backend, const Pruning& pruning) {
  const auto goes = [&](KeyframeId id) { return pruning.keyframes.contains(id); };
  for (const Wall& wall : backend.walls())
    if (goes(wall.anchor) && sent_walls_.erase(wall.id) > 0) gone_walls_.push_back(wall.id);
  for (const LoopClosure& closure : backend.closures().values())
    if (goes(closure.from) || goes(closure.to)) sent_closures_.erase(closure.id);
}

void MapFeed::hand_on_confidence(Backend& backend, bool has_keyframe) {
  const TrackingFigures figures = backend.tracking();
  publisher_.tracking.store(figures);
  if (!has_keyframe && figures.tracking == tracking_) return;
  tracking_ = figures.tracking;
  publisher_.confidence.store(backend.confidence());
}

void MapFeed::flush(const Backend& backend, const MapBuilder& map) {
  publisher_.counters.store(backend.counters());
  flush_tiles(map);
  if (closures_pending_) closures_pending_ = !flush_closures(backend);
  if (flush_gone_walls() && walls_pending_) walls_pending_ = !flush_walls(backend);
}

void MapFeed::flush_tiles(const MapBuilder& map) {
  while (!dirty_tiles_.empty() && publisher_.tiles.has_room()) {
    const auto first = dirty_tiles_.begin();
    static_cast<void>(publisher_.tiles.try_push(map.tile(*first)));  // has room
    dirty_tiles_.erase(first);
  }
}

bool MapFeed::flush_gone_walls() {
  while (!gone_walls_.empty() && publisher_.walls.has_room()) {
    static_cast<void>(publisher_.walls.try_push({.id = gone_walls_.back(), .is_gone = true}));  // has room
    gone_walls_.pop_back();
  }
  return gone_walls_.empty();
}

bool MapFeed::flush_walls(const Backend& backend) {
  for (const Wall& wall : backend.walls()) {
    const WallInMap now = in_map(wall, backend);
    const auto sent = sent_walls_.find(wall.id);
    if (sent != sent_walls_.end() && !moved(sent->second.start_map, now.start_map) &&
        !moved(sent->second.end_map, now.end_map))
      continue;
    if (!publisher_.walls.has_room()) return false;
    static_cast<void>(publisher_.walls.try_push(now));  // has room
    sent_walls_.insert_or_assign(wall.id, now);
  }
  return true;
}

bool MapFeed::flush_closures(const Backend& backend) {
  for (const LoopClosure& closure : backend.closures().values()) {
    const auto sent = sent_closures_.find(closure.id);
    if (sent != sent_closures_.end() && sent->second == closure.dropped) continue;
    if (!publisher_.closures.has_room()) return false;
    static_cast<void>(publisher_.closures.try_push(  // has room
        {.closure = closure,
         .from_map = backend.T_map_keyframe(closure.from).position(),
         .to_map = backend.T_map_keyframe(closure.to).position(),
         .storey = backend.keyframes().storey(closure.to)}));
    sent_closures_.insert_or_assign(closure.id, closure.dropped);
  }
  return true;
}

}  // namespace swiftlet

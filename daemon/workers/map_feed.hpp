// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "core/backend/backend.hpp"
#include "core/mapping/map_builder.hpp"
#include "daemon/workers/pipeline_queues.hpp"

namespace swiftlet {

/// Gives what changed in the map to the publisher, and keeps what its queues had no room for. Nothing is
/// lost: what is offered again is the newest state, not each step on the way.
/// One thread at a time (the backend's). Allocates.
class MapFeed {
 public:
  explicit MapFeed(const BackendOutlet& publisher) : publisher_(publisher) {}

  /// These tiles have new content; walls and closures may have.
  void note_changes(std::span<const TileIndex> changed_tiles);
  /// The backend is about to prune this.
  void prune(const Backend& backend, const Pruning& pruning);
  /// After each step: the state of tracking, with new covariances where a keyframe was made or it changed.
  void hand_on_confidence(Backend& backend, bool has_keyframe);
  /// Hands over what there is room for, and the backend's counters.
  void flush(const Backend& backend, const MapBuilder& map);
  /// True when the publisher has been given everything.
  [[nodiscard]] bool is_empty() const {
    return dirty_tiles_.empty() && gone_walls_.empty() && !walls_pending_ && !closures_pending_;
  }
  /// Nothing more will come: ends the publisher's queue.
  void close() { publisher_.tiles.close(); }

 private:
  BackendOutlet publisher_;
  Tracking tracking_ = Tracking::kTracking;  // as handed over last
  std::set<TileIndex> dirty_tiles_;
  bool walls_pending_ = false;
  bool closures_pending_ = false;
  std::map<LandmarkId, WallInMap> sent_walls_;
  std::vector<LandmarkId> gone_walls_;       // not yet published as gone
  std::map<ClosureId, bool> sent_closures_;  // whether each was sent as dropped

  void flush_tiles(const MapBuilder& map);
  [[nodiscard]] bool flush_gone_walls();
  [[nodiscard]] bool flush_walls(const Backend& backend);
  [[nodiscard]] bool flush_closures(const Backend& backend);
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <vector>

#include "core/backend/backend.hpp"
#include "core/mapping/map_config.hpp"
#include "core/mapping/map_tile.hpp"

namespace swiftlet {

/// Draws the occupancy map from the backend's scans at their corrected poses, and follows when poses change:
/// the pose at which a scan was drawn is stored, so that it is taken out there exactly (cells count hits and
/// misses as integers) and drawn anew. While flying, scans follow once they would move by half a cell, and
/// those whose place is in doubt (Backend::doubted_since()) wait until it is known; once settled, all are
/// drawn, and the map depends on the final poses alone, never on the order of corrections. Allocates as the
/// map grows. One thread at a time (the backend's).
class MapBuilder {
 public:
  /// Precondition: config.validate() is empty.
  MapBuilder(const MapConfig& config, const SensorModel& sensor);
  ~MapBuilder();
  MapBuilder(const MapBuilder&) = delete;
  MapBuilder& operator=(const MapBuilder&) = delete;

  /// Draws scans added since the last call, or rubs out those that have come into doubt, and redraws, of the
  /// `refined` ones and, when `poses_changed`, of all in this and the next updates, those that moved
  /// noticeably. Returns the tiles whose published content changed, in index order.
  std::vector<TileIndex> update(const Backend& backend, bool poses_changed, const ScanRange& refined = {});
  /// Whether more scans wait than one update draws: of a vehicle that stands, or that doubt has left.
  [[nodiscard]] bool is_behind(const Backend& backend) const;
  /// Draws some of them. Precondition: no keyframe was added since update(). Returns as update() does.
  std::vector<TileIndex> catch_up(const Backend& backend);
  /// Rubs out what the backend is about to prune. What is left unknown shows with the next update.
  void prune(const Backend& backend, const Pruning& pruning);
  /// Draws every scan exactly where the backend has it. Returns as update() does.
  std::vector<TileIndex> settle(const Backend& backend);

  [[nodiscard]] MapTile tile(TileIndex index) const;
  /// All tiles that hold anything, in index order; those of one storey.
  [[nodiscard]] std::vector<TileIndex> tiles() const;
  [[nodiscard]] std::vector<TileIndex> tiles(StoreyId storey) const;
  /// The first, and the others that have tiles, ascending.
  [[nodiscard]] std::vector<StoreyId> storeys() const;
  [[nodiscard]] const MapConfig& config() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace swiftlet

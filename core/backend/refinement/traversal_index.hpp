// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/backend/config/backend_tuning.hpp"
#include "core/base/id_map.hpp"
#include "core/base/ids.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// What a traversal over a place saw of its walls, one point a cell, as seen from one of its scans: it moves
/// as a whole with that scan.
struct TraversalWalls {
  ScanId reference{};
  StoreyId storey{};
  std::vector<Point2> points_reference;
};

/// Finds the traversals that drew walls near a place, by coarse tiles of the map. Looking up costs the same
/// however long the run; so do the points that come of it. Allocates. One thread at a time.
class TraversalIndex {
 public:
  /// `reach_m`: so far from a place its walls may lie.
  explicit TraversalIndex(const TraversalIndexTuning& tuning = {}, double reach_m = WallFitTuning{}.radius_m)
      : tuning_(tuning), margin_m_(reach_m + tuning.refile_m) {}

  /// Files the next traversal, or an earlier one anew. More than the most points: some are left out, evenly.
  void set(TraversalId traversal, TraversalWalls walls, const Pose2& T_map_reference);
  void erase(const IdRanges<TraversalId>& pruned);
  /// The traversal is now there; nothing to do unless it left its tiles.
  void move(TraversalId traversal, const Pose2& T_map_reference);

  [[nodiscard]] std::size_t size() const { return traversals_.size(); }
  /// The traversal that is filed next.
  [[nodiscard]] TraversalId end_id() const { return traversals_.end_id(); }
  /// Those of the range that were filed and not erased, ascending.
  [[nodiscard]] std::vector<TraversalId> filed(IdRange<TraversalId> range) const;
  [[nodiscard]] const TraversalWalls& operator[](TraversalId traversal) const {
    return traversals_[traversal].walls;
  }
  /// Traversals with walls within reach of the places on that storey, ascending, but for the
  /// excluded ones.
  /// Where a tile has more than the most, they are chosen evenly from the first to the last.
  [[nodiscard]] std::vector<TraversalId> near(std::span<const Point2> places_map, StoreyId storey,
                                              const IdRange<TraversalId>& excluded) const;

 private:
  using Tile = std::pair<std::int32_t, std::int32_t>;
  struct Filed {
    TraversalWalls walls;
    Pose2 T_map_reference;  // when it was filed
    double reach_m = 0.0;   // of its farthest point from the reference
    std::vector<Tile> tiles;
  };
  [[nodiscard]] Tile tile_of(const Point2& p_map) const;
  void file(TraversalId traversal, const Pose2& T_map_reference);
  void unfile(TraversalId traversal);

  TraversalIndexTuning tuning_;
  double margin_m_;  // with what a traversal may have moved since it was filed
  IdMap<TraversalId, Filed> traversals_;
  using Tiles = std::map<Tile, std::vector<TraversalId>>;  // traversals ascending
  std::map<StoreyId, Tiles> storeys_;
};

}  // namespace swiftlet

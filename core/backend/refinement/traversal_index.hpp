// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/backend/store/scan_store.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// What a traversal over a place saw of its walls, one point a cell, as seen from one of its scans: it moves
/// as a whole with that scan.
struct TraversalWalls {
  ScanIndex reference = 0;
  std::vector<Point2> points_reference;
};

/// Finds the traversals that drew walls near a place, by coarse tiles of the map. Looking up costs the same
/// however long the run; so do the points that come of it. Allocates. One thread at a time.
class TraversalIndex {
 public:
  static constexpr std::size_t kMaxPointsPerTraversal = 256;
  static constexpr std::size_t kMaxTraversalsNearby = 64;
  static constexpr std::size_t kMaxTraversalsPerTile = 8;

  /// Files a traversal, or files it anew. Passes are numbered from 0 without gaps. More than the most points:
  /// some are left out, evenly.
  void set(std::uint32_t traversal, TraversalWalls walls, const Pose2& T_map_reference);
  /// Forgets traversals; their scans were removed too.
  void remove(const IndexRemoval& traversals, const IndexRemoval& scans);
  /// The traversal is now there; nothing to do unless it left its tiles.
  void move(std::uint32_t traversal, const Pose2& T_map_reference);

  [[nodiscard]] std::size_t size() const { return traversals_.size(); }
  [[nodiscard]] const TraversalWalls& operator[](std::uint32_t traversal) const {
    return traversals_[traversal].walls;
  }
  /// Passes with walls within about half a metre of the places, ascending. Where a tile has more than the
  /// most, they are chosen evenly from the first to the last. None in [excluded_first, excluded_end).
  [[nodiscard]] std::vector<std::uint32_t> near(std::span<const Point2> places_map,
                                                std::uint32_t excluded_first,
                                                std::uint32_t excluded_end) const;

 private:
  using Tile = std::pair<std::int32_t, std::int32_t>;
  struct Filed {
    TraversalWalls walls;
    Pose2 T_map_reference;  // when it was filed
    double reach_m = 0.0;   // of its farthest point from the reference
    std::vector<Tile> tiles;
  };
  void file(std::uint32_t traversal, const Pose2& T_map_reference);
  void unfile(std::uint32_t traversal);

  std::vector<Filed> traversals_;
  std::map<Tile, std::vector<std::uint32_t>> tiles_;  // traversals ascending
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/traversal_index.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"

namespace swiftlet {
namespace {

constexpr double kTileM = 2.0;
constexpr double kMarginM =
    0.5;  // walls this far off their places are found, less what traversals moved since ...
constexpr double kRefileM = 0.2;  // ... which is no more than this

std::int32_t tile_of(double m) { return static_cast<std::int32_t>(std::floor(m / kTileM)); }

template <typename T>
void sort_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

void TraversalIndex::set(std::uint32_t traversal, TraversalWalls walls, const Pose2& T_map_reference) {
  SWIFTLET_CHECK(traversal <= traversals_.size(), "traversals are numbered without gaps");
  if (traversal == traversals_.size()) traversals_.emplace_back();
  unfile(traversal);
  Filed& filed = traversals_[traversal];
  filed.walls = std::move(walls);
  std::vector<Point2>& points = filed.walls.points_reference;
  if (const std::size_t count = points.size(); count > kMaxPointsPerTraversal) {
    for (std::size_t i = 0; i < kMaxPointsPerTraversal; ++i)
      points[i] = points[i * count / kMaxPointsPerTraversal];
    points.resize(kMaxPointsPerTraversal);
  }
  filed.reach_m = 0.0;
  for (const Point2& p : points) filed.reach_m = std::max(filed.reach_m, std::hypot(p.x_m, p.y_m));
  file(traversal, T_map_reference);
}

void TraversalIndex::remove(const IndexRemoval& traversals, const IndexRemoval& scans) {
  traversals.apply(traversals_);
  tiles_.clear();
  for (std::uint32_t traversal = 0; traversal < traversals_.size(); ++traversal) {
    Filed& filed = traversals_[traversal];
    filed.walls.reference = scans.new_index(filed.walls.reference);
    for (const Tile& tile : filed.tiles) tiles_[tile].push_back(traversal);
  }
}

void TraversalIndex::move(std::uint32_t traversal, const Pose2& T_map_reference) {
  const Filed& filed = traversals_[traversal];
  const Pose2 moved = between(filed.T_map_reference, T_map_reference);
  const double farthest_m = std::hypot(moved.x_m(), moved.y_m()) + std::abs(moved.yaw_rad()) * filed.reach_m;
  if (farthest_m <= kRefileM) return;
  unfile(traversal);
  file(traversal, T_map_reference);
}

void TraversalIndex::file(std::uint32_t traversal, const Pose2& T_map_reference) {
  Filed& filed = traversals_[traversal];
  filed.T_map_reference = T_map_reference;
  for (const Point2& p_reference : filed.walls.points_reference) {
    const Point2 p_map = T_map_reference * p_reference;
    filed.tiles.emplace_back(tile_of(p_map.x_m), tile_of(p_map.y_m));
  }
  sort_unique(filed.tiles);
  for (const Tile& tile : filed.tiles) {
    std::vector<std::uint32_t>& there = tiles_[tile];
    there.insert(std::lower_bound(there.begin(), there.end(), traversal), traversal);
  }
}

void TraversalIndex::unfile(std::uint32_t traversal) {
  for (const Tile& tile : traversals_[traversal].tiles) {
    const auto at = tiles_.find(tile);
    at->second.erase(std::lower_bound(at->second.begin(), at->second.end(), traversal));
    if (at->second.empty()) tiles_.erase(at);
  }
  traversals_[traversal].tiles.clear();
}

std::vector<std::uint32_t> TraversalIndex::near(std::span<const Point2> places_map,
                                                std::uint32_t excluded_first,
                                                std::uint32_t excluded_end) const {
  std::vector<Tile> tiles;
  for (const Point2& p : places_map) {
    const Tile low(tile_of(p.x_m - kMarginM), tile_of(p.y_m - kMarginM));
    const Tile high(tile_of(p.x_m + kMarginM), tile_of(p.y_m + kMarginM));
    for (std::int32_t x = low.first; x <= high.first; ++x)
      for (std::int32_t y = low.second; y <= high.second; ++y)
        if (tiles.empty() || tiles.back() != Tile(x, y)) tiles.emplace_back(x, y);
  }
  sort_unique(tiles);

  std::vector<std::vector<std::uint32_t>> choices;  // of each tile
  for (const Tile& tile : tiles) {
    const auto at = tiles_.find(tile);
    if (at == tiles_.end()) continue;
    const std::vector<std::uint32_t>& there = at->second;
    const auto first_out = std::lower_bound(there.begin(), there.end(), excluded_first);
    const auto first_after = std::lower_bound(first_out, there.end(), excluded_end);
    const auto before = static_cast<std::size_t>(first_out - there.begin());
    const auto gap = static_cast<std::size_t>(first_after - first_out);
    const std::size_t count = there.size() - gap;
    const std::size_t taken = std::min(count, kMaxTraversalsPerTile);
    std::vector<std::uint32_t>& chosen = choices.emplace_back();
    for (std::size_t k = 0; k < taken; ++k) {
      const std::size_t i = taken == 1 ? 0 : k * (count - 1) / (taken - 1);
      chosen.push_back(there[i < before ? i : i + gap]);
    }
  }
  std::vector<std::uint32_t> found;
  for (std::size_t k = 0; k < kMaxTraversalsPerTile && found.size() < kMaxTraversalsNearby; ++k) {
    for (const std::vector<std::uint32_t>& chosen : choices)
      if (k < chosen.size()) found.push_back(chosen[k]);
    sort_unique(found);
  }
  if (found.size() > kMaxTraversalsNearby) found.resize(kMaxTraversalsNearby);
  return found;
}

}  // namespace swiftlet

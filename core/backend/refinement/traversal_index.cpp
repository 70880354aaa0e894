// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/traversal_index.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/geometry/grid.hpp"

namespace swiftlet {
namespace {

template <typename T>
void sort_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// Which one of `count` is the k-th of `taken`, from the first to the last.
std::size_t evenly(std::size_t k, std::size_t taken, std::size_t count) {
  return taken == 1 ? 0 : k * (count - 1) / (taken - 1);
}

}  // namespace

TraversalIndex::Tile TraversalIndex::tile_of(const Point2& p_map) const {
  return {floor_to_int(p_map.x_m / tuning_.tile_m), floor_to_int(p_map.y_m / tuning_.tile_m)};
}

void TraversalIndex::set(TraversalId traversal, TraversalWalls walls, const Pose2& T_map_reference) {
  SWIFTLET_CHECK(traversal <= traversals_.end_id(), "traversals are filed in order");
  if (traversal == traversals_.end_id()) traversals_.push_back({});
  unfile(traversal);
  Filed& filed = traversals_[traversal];
  filed.walls = std::move(walls);
  std::vector<Point2>& points = filed.walls.points_reference;
  if (const std::size_t count = points.size(); count > tuning_.max_points_per_traversal) {
    for (std::size_t i = 0; i < tuning_.max_points_per_traversal; ++i)
      points[i] = points[i * count / tuning_.max_points_per_traversal];
    points.resize(tuning_.max_points_per_traversal);
  }
  filed.reach_m = 0.0;
  for (const Point2& p : points) filed.reach_m = std::max(filed.reach_m, std::hypot(p.x_m, p.y_m));
  file(traversal, T_map_reference);
}

void TraversalIndex::erase(const IdRanges<TraversalId>& pruned) {
  for (const IdRange<TraversalId>& range : pruned)
    for (const TraversalId traversal : filed(range)) unfile(traversal);
  traversals_.erase(pruned);
}

std::vector<TraversalId> TraversalIndex::filed(IdRange<TraversalId> range) const {
  std::vector<TraversalId> ids;
  range.end = std::min(range.end, traversals_.end_id());
  for (TraversalId id = traversals_.at_or_after(range.first); id < range.end; id = traversals_.next(id))
    ids.push_back(id);
  return ids;
}

void TraversalIndex::move(TraversalId traversal, const Pose2& T_map_reference) {
  const Filed& filed = traversals_[traversal];
  const Pose2 moved = between(filed.T_map_reference, T_map_reference);
  const double farthest_m = std::hypot(moved.x_m(), moved.y_m()) + std::abs(moved.yaw_rad()) * filed.reach_m;
  if (farthest_m <= tuning_.refile_m) return;
  unfile(traversal);
  file(traversal, T_map_reference);
}

void TraversalIndex::file(TraversalId traversal, const Pose2& T_map_reference) {
  Filed& filed = traversals_[traversal];
  filed.T_map_reference = T_map_reference;
  for (const Point2& p_reference : filed.walls.points_reference) {
    const Point2 p_map = T_map_reference * p_reference;
    filed.tiles.push_back(tile_of(p_map));
  }
  sort_unique(filed.tiles);
  Tiles& tiles = storeys_[filed.walls.storey];
  for (const Tile& tile : filed.tiles) {
    std::vector<TraversalId>& there = tiles[tile];
    there.insert(std::lower_bound(there.begin(), there.end(), traversal), traversal);
  }
}

void TraversalIndex::unfile(TraversalId traversal) {
  Filed& filed = traversals_[traversal];
  Tiles& tiles = storeys_[filed.walls.storey];
  for (const Tile& tile : filed.tiles) {
    const auto at = tiles.find(tile);
    at->second.erase(std::lower_bound(at->second.begin(), at->second.end(), traversal));
    if (at->second.empty()) tiles.erase(at);
  }
  filed.tiles.clear();
}

std::vector<TraversalId> TraversalIndex::near(std::span<const Point2> places_map, StoreyId storey,
                                              const IdRange<TraversalId>& excluded) const {
  const auto drawn = storeys_.find(storey);
  if (drawn == storeys_.end()) return {};
  std::vector<Tile> tiles;
  for (const Point2& p : places_map) {
    const Tile low = tile_of({p.x_m - margin_m_, p.y_m - margin_m_});
    const Tile high = tile_of({p.x_m + margin_m_, p.y_m + margin_m_});
    for (std::int32_t x = low.first; x <= high.first; ++x)
      for (std::int32_t y = low.second; y <= high.second; ++y)
        if (tiles.empty() || tiles.back() != Tile(x, y)) tiles.emplace_back(x, y);
  }
  sort_unique(tiles);

  std::vector<TraversalId> found;
  for (const Tile& tile : tiles) {
    const auto at = drawn->second.find(tile);
    if (at == drawn->second.end()) continue;
    const std::vector<TraversalId>& there = at->second;
    const auto first_out = std::lower_bound(there.begin(), there.end(), excluded.first);
    const auto first_after = std::lower_bound(first_out, there.end(), excluded.end);
    const auto before = static_cast<std::size_t>(first_out - there.begin());
    const auto gap = static_cast<std::size_t>(first_after - first_out);
    const std::size_t count = there.size() - gap;
    const std::size_t taken = std::min(count, tuning_.max_traversals_per_tile);
    for (std::size_t k = 0; k < taken; ++k) {
      const std::size_t i = evenly(k, taken, count);
      found.push_back(there[i < before ? i : i + gap]);
    }
  }
  sort_unique(found);
  const std::size_t most = tuning_.max_traversals_nearby;
  if (found.size() <= most) return found;
  for (std::size_t k = 0; k < most; ++k) found[k] = found[evenly(k, most, found.size())];
  found.resize(most);
  return found;
}

}  // namespace swiftlet

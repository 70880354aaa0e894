// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/wall_map.hpp"

#include <algorithm>
#include <array>

#include "core/geometry/cell_numbers.hpp"
#include "core/geometry/grid.hpp"

namespace swiftlet {

std::optional<LocalWall> wall_through(const Moments2& moments, const Point2& place_map,
                                      const WallFitTuning& tuning) {
  if (moments.count < tuning.min_points) return std::nullopt;
  const Scatter2 scatter = moments.scatter();
  const double along = scatter.along();
  if (along < tuning.min_variance_m2) return std::nullopt;
  if (scatter.across() > tuning.max_variance_ratio * along) return std::nullopt;
  return LocalWall{{place_map.x_m + scatter.mean.x_m, place_map.y_m + scatter.mean.y_m}, scatter.normal()};
}

void append_thinned(std::span<const TraversalPoint> points, double cell_m,
                    std::vector<TraversalPoint>& thinned) {
  CellNumbers numbers(cell_m);
  std::vector<std::uint32_t> counts;
  for (std::size_t begin = 0; begin < points.size();) {
    const std::uint32_t traversal = points[begin].traversal;
    const auto is_other = [&](const TraversalPoint& p) { return p.traversal != traversal; };
    const auto rest = points.subspan(begin);
    const auto of_traversal =
        rest.first(static_cast<std::size_t>(std::find_if(rest.begin(), rest.end(), is_other) - rest.begin()));
    begin += of_traversal.size();
    numbers.reset(of_traversal.size());
    counts.clear();
    const std::size_t first = thinned.size();
    for (const TraversalPoint& p : of_traversal) {
      const std::size_t number = numbers.number_of(p.p_map);
      if (number == counts.size()) {
        counts.push_back(0);
        thinned.push_back({{}, traversal});
      }
      Point2& sum = thinned[first + number].p_map;
      sum = {sum.x_m + p.p_map.x_m, sum.y_m + p.p_map.y_m};
      ++counts[number];
    }
    for (std::size_t k = 0; k < counts.size(); ++k) {
      Point2& p = thinned[first + k].p_map;
      p = {p.x_m / counts[k], p.y_m / counts[k]};
    }
  }
}

WallMap::WallMap(std::span<const TraversalPoint> thinned, std::span<const TraversalPoint> points,
                 double radius_m, const RefinementTuning& tuning)
    : tuning_(tuning), radius_m_(radius_m) {
  std::vector<TraversalPoint> all;
  all.reserve(thinned.size() + points.size());
  all.assign(thinned.begin(), thinned.end());
  append_thinned(points, tuning.thinning_cell_m, all);
  if (!all.empty()) points_ = PointColumns(sorted_into_cells(all));
}

std::vector<TraversalPoint> WallMap::sorted_into_cells(const std::vector<TraversalPoint>& points) {
  Point2 high = points.front().p_map;
  origin_m_ = high;
  for (const TraversalPoint& p : points) {
    origin_m_ = {std::min(origin_m_.x_m, p.p_map.x_m), std::min(origin_m_.y_m, p.p_map.y_m)};
    high = {std::max(high.x_m, p.p_map.x_m), std::max(high.y_m, p.p_map.y_m)};
  }
  width_ = static_cast<int>((high.x_m - origin_m_.x_m) / radius_m_) + 1;
  height_ = static_cast<int>((high.y_m - origin_m_.y_m) / radius_m_) + 1;
  const auto cell_of = [&](const TraversalPoint& p) {
    const auto x = static_cast<std::size_t>((p.p_map.x_m - origin_m_.x_m) / radius_m_);
    const auto y = static_cast<std::size_t>((p.p_map.y_m - origin_m_.y_m) / radius_m_);
    return y * static_cast<std::size_t>(width_) + x;
  };
  cell_starts_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) + 1, 0);
  for (const TraversalPoint& p : points) ++cell_starts_[cell_of(p) + 1];
  for (std::size_t i = 1; i < cell_starts_.size(); ++i) cell_starts_[i] += cell_starts_[i - 1];
  std::vector<std::uint32_t> next(cell_starts_.begin(), cell_starts_.end() - 1);
  std::vector<TraversalPoint> sorted(points.size());
  for (const TraversalPoint& p : points) sorted[next[cell_of(p)]++] = p;
  return sorted;
}

std::optional<LocalWall> WallMap::wall_near(const TraversalPoint& place) const {
  if (points_.size() == 0) return std::nullopt;
  const int cx = floor_to_int((place.p_map.x_m - origin_m_.x_m) / radius_m_);
  const int cy = floor_to_int((place.p_map.y_m - origin_m_.y_m) / radius_m_);
  const int first_x = std::max(0, cx - 1);
  const int last_x = std::min(width_ - 1, cx + 1);
  if (first_x > last_x) return std::nullopt;
  std::array<PointRange, 3> rows;  // of cells
  std::size_t count = 0;
  for (int y = std::max(0, cy - 1); y <= std::min(height_ - 1, cy + 1); ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
    rows[count++] = {cell_starts_[row + static_cast<std::size_t>(first_x)],
                     cell_starts_[row + static_cast<std::size_t>(last_x) + 1]};
  }
  return wall_through(local_moments(points_, {rows.data(), count}, place, radius_m_), place.p_map,
                      tuning_.walls);
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/wall_patches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/backend/refinement/wall_map.hpp"
#include "core/geometry/grid.hpp"
#include "core/geometry/moments2.hpp"

namespace swiftlet {
namespace {

double dot(const Point2& a, const Point2& b) { return a.x_m * b.x_m + a.y_m * b.y_m; }

/// The returns sorted by cell; within a cell in their own order.
class ReturnsByCell {
 public:
  ReturnsByCell(std::span<const DrawnReturn> returns, double cell_m) : cell_m_(cell_m) {
    std::vector<CellIndex> cell_of_return;
    cell_of_return.reserve(returns.size());
    for (const DrawnReturn& drawn : returns) cell_of_return.push_back(cell_at(drawn.p_map));
    index_.resize(returns.size());
    std::iota(index_.begin(), index_.end(), 0U);
    std::ranges::stable_sort(index_, {}, [&](std::uint32_t i) { return cell_of_return[i]; });
    cells_.reserve(returns.size());
    sorted_.reserve(returns.size());
    for (const std::uint32_t i : index_) {
      sorted_.push_back(returns[i]);
      cells_.push_back(cell_of_return[i]);
    }
  }
  [[nodiscard]] std::size_t size() const { return sorted_.size(); }
  [[nodiscard]] const DrawnReturn& operator[](std::size_t position) const { return sorted_[position]; }
  /// Before the sorting.
  [[nodiscard]] std::uint32_t index_of(std::size_t position) const { return index_[position]; }
  /// The position behind the returns that share the cell of this one.
  [[nodiscard]] std::size_t cell_end(std::size_t position) const {
    return position_of(std::upper_bound(cells_.begin(), cells_.end(), cells_[position]));
  }
  /// Those in cells from `low` to `high` of a column of cells, which lie together.
  [[nodiscard]] std::span<const DrawnReturn> from_to(std::int32_t x, std::int32_t low,
                                                     std::int32_t high) const {
    const auto first = std::lower_bound(cells_.begin(), cells_.end(), CellIndex{x, low});
    const auto last = std::upper_bound(first, cells_.end(), CellIndex{x, high});
    return std::span(sorted_).subspan(position_of(first), static_cast<std::size_t>(last - first));
  }
  [[nodiscard]] CellIndex cell_at(const Point2& p_map) const { return cell_of(p_map, cell_m_); }

 private:
  [[nodiscard]] std::size_t position_of(std::vector<CellIndex>::const_iterator at) const {
    return static_cast<std::size_t>(at - cells_.begin());
  }

  double cell_m_;
  std::vector<CellIndex> cells_;  // ascending
  std::vector<std::uint32_t> index_;
  std::vector<DrawnReturn> sorted_;
};

/// Of the face around a return, towards the sensor.
std::optional<Point2> normal_at(const DrawnReturn& at, const ReturnsByCell& returns,
                                const WallFitTuning& tuning) {
  const double reach_m = tuning.radius_m;
  const CellIndex low = returns.cell_at({at.p_map.x_m - reach_m, at.p_map.y_m - reach_m});
  const CellIndex high = returns.cell_at({at.p_map.x_m + reach_m, at.p_map.y_m + reach_m});
  Moments2 moments;
  for (std::int32_t x = low.x; x <= high.x; ++x) {
    for (const DrawnReturn& other : returns.from_to(x, low.y, high.y)) {
      const double dx = other.p_map.x_m - at.p_map.x_m;
      const double dy = other.p_map.y_m - at.p_map.y_m;
      if (dx * dx + dy * dy > reach_m * reach_m) continue;
      if (dot(other.direction_map, at.direction_map) > 0.0) moments.add({dx, dy});
    }
  }
  const std::optional<LocalWall> wall = wall_through(moments, at.p_map, tuning);
  if (!wall) return std::nullopt;
  const Point2& normal = wall->normal_map;
  return dot(normal, at.direction_map) > 0.0 ? Point2{-normal.x_m, -normal.y_m} : normal;
}

struct OnWall {
  std::uint32_t index = 0;
  Point2 p_map;
  Point2 normal_map;
};

bool is_together(const OnWall& seed, const OnWall& other, const WallPatchesTuning& tuning) {
  const Point2 off{other.p_map.x_m - seed.p_map.x_m, other.p_map.y_m - seed.p_map.y_m};
  return dot(seed.normal_map, other.normal_map) > tuning.min_agreement &&
         std::abs(dot(off, seed.normal_map)) < tuning.max_off_m;
}

WallPatch mean_of(const std::vector<OnWall>& members) {
  Point2 center;
  Point2 normal;
  for (const OnWall& member : members) {
    center = {center.x_m + member.p_map.x_m, center.y_m + member.p_map.y_m};
    normal = {normal.x_m + member.normal_map.x_m, normal.y_m + member.normal_map.y_m};
  }
  const auto n = static_cast<double>(members.size());
  const double length = std::hypot(normal.x_m, normal.y_m);
  return {{center.x_m / n, center.y_m / n}, {normal.x_m / length, normal.y_m / length}};
}

/// The one with most others on its patch.
const OnWall& best_seed(const std::vector<OnWall>& left, const WallPatchesTuning& tuning) {
  std::size_t best = 0;
  std::ptrdiff_t most = -1;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const auto together = std::count_if(
        left.begin(), left.end(), [&](const OnWall& other) { return is_together(left[i], other, tuning); });
    if (together > most) {
      most = together;
      best = i;
    }
  }
  return left[best];
}

/// Splits the returns of one cell into patches, the largest first.
void split_cell(std::vector<OnWall> left, const WallPatchesTuning& tuning, WallPatches& result) {
  while (left.size() >= tuning.min_returns) {
    const OnWall seed = best_seed(left, tuning);
    const auto rest = std::stable_partition(
        left.begin(), left.end(), [&](const OnWall& other) { return is_together(seed, other, tuning); });
    const std::vector<OnWall> members(left.begin(), rest);
    if (members.size() < tuning.min_returns) return;
    for (const OnWall& member : members)
      result.patch_of[member.index] = static_cast<std::uint32_t>(result.patches.size());
    result.patches.push_back(mean_of(members));
    left.erase(left.begin(), rest);
  }
}

}  // namespace

WallPatches find_wall_patches(std::span<const DrawnReturn> returns, const WallFitTuning& fit,
                              const WallPatchesTuning& tuning) {
  WallFitTuning around = fit;
  around.min_points = tuning.min_neighbours;
  around.min_variance_m2 = tuning.min_length_m2;
  WallPatches result;
  result.patch_of.assign(returns.size(), WallPatches::kNone);
  const ReturnsByCell by_cell(returns, tuning.cell_m);
  for (std::size_t at = 0; at < by_cell.size();) {
    std::vector<OnWall> in_cell;
    for (const std::size_t end = by_cell.cell_end(at); at < end; ++at)
      if (const std::optional<Point2> normal = normal_at(by_cell[at], by_cell, around))
        in_cell.push_back({by_cell.index_of(at), by_cell[at].p_map, *normal});
    split_cell(std::move(in_cell), tuning, result);
  }
  return result;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/wall_map.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/cell_numbers.hpp"

namespace swiftlet {
namespace {

constexpr double kThinningM = 0.08;
constexpr int kMinPoints = 5;
constexpr double kMinLengthM2 = 0.004;  // variance along the wall: shorter stretches have no direction
constexpr double kMaxRatio = 0.35;      // variance across to variance along: more is clutter, not a wall

/// Weighted moments of the points around a place.
struct Moments {
  int count = 0;
  double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  void add(double weight, double dx, double dy) {
    ++count;
    w += weight;
    x += weight * dx;
    y += weight * dy;
    xx += weight * dx * dx;
    xy += weight * dx * dy;
    yy += weight * dy * dy;
  }
};

}  // namespace

void append_thinned(std::span<const TraversalPoint> points, std::vector<TraversalPoint>& thinned) {
  CellNumbers numbers(kThinningM);
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
                 double radius_m)
    : radius_m_(radius_m) {
  points_.reserve(thinned.size() + points.size());
  points_.assign(thinned.begin(), thinned.end());
  append_thinned(points, points_);
  sort_into_cells();
}

void WallMap::sort_into_cells() {
  if (points_.empty()) return;
  Point2 high = points_.front().p_map;
  origin_m_ = high;
  for (const TraversalPoint& p : points_) {
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
  for (const TraversalPoint& p : points_) ++cell_starts_[cell_of(p) + 1];
  for (std::size_t i = 1; i < cell_starts_.size(); ++i) cell_starts_[i] += cell_starts_[i - 1];
  std::vector<std::uint32_t> next(cell_starts_.begin(), cell_starts_.end() - 1);
  std::vector<TraversalPoint> sorted(points_.size());
  for (const TraversalPoint& p : points_) sorted[next[cell_of(p)]++] = p;
  points_.swap(sorted);
}

std::optional<LocalWall> WallMap::wall_near(const TraversalPoint& place) const {
  if (points_.empty()) return std::nullopt;
  const int cx = static_cast<int>(std::floor((place.p_map.x_m - origin_m_.x_m) / radius_m_));
  const int cy = static_cast<int>(std::floor((place.p_map.y_m - origin_m_.y_m) / radius_m_));
  const double r2 = radius_m_ * radius_m_;
  Moments m;
  for (int y = std::max(0, cy - 1); y <= std::min(height_ - 1, cy + 1); ++y) {
    const int first_x = std::max(0, cx - 1);
    const int last_x = std::min(width_ - 1, cx + 1);
    if (first_x > last_x) break;
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
    const std::uint32_t begin = cell_starts_[row + static_cast<std::size_t>(first_x)];
    const std::uint32_t end = cell_starts_[row + static_cast<std::size_t>(last_x) + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const double dx = points_[i].p_map.x_m - place.p_map.x_m;
      const double dy = points_[i].p_map.y_m - place.p_map.y_m;
      const double d2 = dx * dx + dy * dy;
      if (d2 >= r2 || points_[i].traversal == place.traversal) continue;
      const double closeness = 1.0 - d2 / r2;
      m.add(closeness, dx, dy);
    }
  }
  if (m.count < kMinPoints) return std::nullopt;
  const double mx = m.x / m.w;
  const double my = m.y / m.w;
  const double xx = m.xx / m.w - mx * mx;
  const double xy = m.xy / m.w - mx * my;
  const double yy = m.yy / m.w - my * my;
  const double half = 0.5 * (xx - yy);
  const double root = std::sqrt(half * half + xy * xy);
  const double along = 0.5 * (xx + yy) + root;
  const double across = xx + yy - along;
  if (along < kMinLengthM2 || across > kMaxRatio * along) return std::nullopt;
  // The eigenvector along the wall: of its two forms the longer, which loses no digits.
  const Point2 direction = half >= 0.0 ? Point2{half + root, xy} : Point2{xy, root - half};
  const double length = std::sqrt(direction.x_m * direction.x_m + direction.y_m * direction.y_m);
  return LocalWall{{place.p_map.x_m + mx, place.p_map.y_m + my},
                   {-direction.y_m / length, direction.x_m / length}};
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cmath>
#include <cstddef>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

struct CellIndex {
  int x = 0;
  int y = 0;
};

/// Where the cells of a dense grid lie in their frame: cell (x, y) covers origin + [x, x + 1) * resolution.
struct GridGeometry {
  Point2 origin_m;
  double resolution_m = 0.1;
  int width = 0;
  int height = 0;

  [[nodiscard]] CellIndex cell(const Point2& p) const {
    return {static_cast<int>(std::floor((p.x_m - origin_m.x_m) / resolution_m)),
            static_cast<int>(std::floor((p.y_m - origin_m.y_m) / resolution_m))};
  }
  [[nodiscard]] Point2 center(CellIndex c) const {
    return {origin_m.x_m + (c.x + 0.5) * resolution_m, origin_m.y_m + (c.y + 0.5) * resolution_m};
  }
  [[nodiscard]] bool contains(CellIndex c) const {
    return c.x >= 0 && c.y >= 0 && c.x < width && c.y < height;
  }
  /// Precondition: contains(c).
  [[nodiscard]] std::size_t offset(CellIndex c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c.x);
  }
  [[nodiscard]] std::size_t cell_count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  /// The smallest grid that holds the box with `margin_m` around it.
  static GridGeometry around(const Point2& low, const Point2& high, double margin_m, double resolution_m) {
    GridGeometry g;
    g.resolution_m = resolution_m;
    g.origin_m = {std::floor((low.x_m - margin_m) / resolution_m) * resolution_m,
                  std::floor((low.y_m - margin_m) / resolution_m) * resolution_m};
    g.width = static_cast<int>(std::ceil((high.x_m + margin_m - g.origin_m.x_m) / resolution_m)) + 1;
    g.height = static_cast<int>(std::ceil((high.y_m + margin_m - g.origin_m.y_m) / resolution_m)) + 1;
    return g;
  }
};

/// Calls visit(cell) for each cell a straight line touches, from the cell of `from` up to but not including
/// the cell of `to` (Amanatides & Woo 1987, "A fast voxel traversal algorithm").
template <typename Visitor>
void walk_ray(const GridGeometry& grid, const Point2& from, const Point2& to, Visitor&& visit) {
  CellIndex at = grid.cell(from);
  const CellIndex end = grid.cell(to);
  const double dx = to.x_m - from.x_m;
  const double dy = to.y_m - from.y_m;
  const int step_x = dx > 0.0 ? 1 : -1;
  const int step_y = dy > 0.0 ? 1 : -1;
  const auto crossing = [&](double start, double delta, double origin, int cell, int step) {
    if (delta == 0.0) return HUGE_VAL;
    return (origin + (cell + (step > 0 ? 1 : 0)) * grid.resolution_m - start) / delta;
  };
  double next_x = crossing(from.x_m, dx, grid.origin_m.x_m, at.x, step_x);
  double next_y = crossing(from.y_m, dy, grid.origin_m.y_m, at.y, step_y);
  const double per_x = dx == 0.0 ? HUGE_VAL : grid.resolution_m / std::abs(dx);
  const double per_y = dy == 0.0 ? HUGE_VAL : grid.resolution_m / std::abs(dy);
  // Counting the steps and not comparing cells: rounding at a corner may traversal beside the end cell.
  const int steps = std::abs(end.x - at.x) + std::abs(end.y - at.y);
  for (int i = 0; i < steps; ++i) {
    visit(at);
    if (next_x < next_y) {
      next_x += per_x;
      at.x += step_x;
    } else {
      next_y += per_y;
      at.y += step_y;
    }
  }
}

}  // namespace swiftlet

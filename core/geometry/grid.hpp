// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// A square cell of a grid; cells are ordered by x, then y.
struct CellIndex {
  std::int32_t x = 0;
  std::int32_t y = 0;
  auto operator<=>(const CellIndex&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// The largest integer not above `value`: std::floor() without its call, and without a branch, where the
/// processor has no instruction for it. Precondition: it fits an int32.
constexpr std::int32_t floor_to_int(double value) {
  const auto towards_zero = static_cast<std::int32_t>(value);
  return towards_zero - static_cast<std::int32_t>(value < towards_zero);
}

/// The cell that holds a point given in cells: [x, x + 1), likewise y. Precondition: both coordinates fit an
/// int32.
constexpr CellIndex cell_of(const Point2& p_cells) {
  return {floor_to_int(p_cells.x_m), floor_to_int(p_cells.y_m)};
}
/// The same of a point in metres, in a grid with a corner at the origin.
inline CellIndex cell_of(const Point2& p, double cell_m) { return cell_of({p.x_m / cell_m, p.y_m / cell_m}); }

/// Where the cells of a dense grid lie in their frame: cell (x, y) covers origin + [x, x + 1) * resolution.
struct GridGeometry {
  Point2 origin_m;
  double resolution_m = 0.1;
  int width = 0;
  int height = 0;

  [[nodiscard]] Point2 in_cells(const Point2& p) const {
    return {(p.x_m - origin_m.x_m) / resolution_m, (p.y_m - origin_m.y_m) / resolution_m};
  }
  [[nodiscard]] CellIndex cell(const Point2& p) const { return cell_of(in_cells(p)); }
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

/// Visits every cell that the straight line between two points (given in cells) passes through, in order,
/// from the first point's cell up to but without the second point's cell. J. Amanatides and A. Woo, "A fast
/// voxel traversal algorithm for ray tracing", Eurographics 1987; unlike there the steps along each axis are
/// counted, so that rounding can neither miss the last cell nor run past it.
template <typename Visit>
void walk_ray(const Point2& from_cells, const Point2& to_cells, Visit&& visit) {
  CellIndex cell = cell_of(from_cells);
  const CellIndex last = cell_of(to_cells);
  const double dx = to_cells.x_m - from_cells.x_m;
  const double dy = to_cells.y_m - from_cells.y_m;
  const int step_x = last.x >= cell.x ? 1 : -1;
  const int step_y = last.y >= cell.y ? 1 : -1;
  int left_x = std::abs(last.x - cell.x);
  int left_y = std::abs(last.y - cell.y);
  // Where along the line (0 to 1) the next border across each axis lies, and how far apart borders are; of no
  // use, and maybe no number, across an axis without steps.
  double next_x = (cell.x + (step_x > 0 ? 1.0 : 0.0) - from_cells.x_m) / dx;
  double next_y = (cell.y + (step_y > 0 ? 1.0 : 0.0) - from_cells.y_m) / dy;
  const double pace_x = 1.0 / std::abs(dx);
  const double pace_y = 1.0 / std::abs(dy);
  while (left_x + left_y > 0) {
    visit(cell);
    if (left_y == 0 || (left_x > 0 && next_x < next_y)) {
      cell.x += step_x;
      next_x += pace_x;
      --left_x;
    } else {
      cell.y += step_y;
      next_y += pace_y;
      --left_y;
    }
  }
}

}  // namespace swiftlet

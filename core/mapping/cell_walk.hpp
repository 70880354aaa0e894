// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>
#include <cstdlib>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// One cell of the map grid: cell (x, y) covers map coordinates [x, x + 1) * resolution, likewise y.
struct CellIndex {
  std::int32_t x = 0;
  std::int32_t y = 0;
  auto operator<=>(const CellIndex&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// The cell that holds a point given in cells. Precondition: both coordinates fit an int32.
inline CellIndex cell_of(const Point2& p_cells) {
  return {static_cast<std::int32_t>(std::floor(p_cells.x_m)),
          static_cast<std::int32_t>(std::floor(p_cells.y_m))};
}

/// Visits every cell that the straight line between two points (given in cells) traversals through, in order,
/// from the first point's cell up to but without the second point's cell. J. Amanatides and A. Woo, "A fast
/// voxel traversal algorithm for ray tracing", Eurographics 1987; unlike there the steps along each axis are
/// counted, so that rounding can neither miss the last cell nor run past it.
template <typename Visit>
void walk_cells(const Point2& from_cells, const Point2& to_cells, Visit&& visit) {
  CellIndex cell = cell_of(from_cells);
  const CellIndex last = cell_of(to_cells);
  const double dx = to_cells.x_m - from_cells.x_m;
  const double dy = to_cells.y_m - from_cells.y_m;
  const int step_x = last.x >= cell.x ? 1 : -1;
  const int step_y = last.y >= cell.y ? 1 : -1;
  int left_x = std::abs(last.x - cell.x);
  int left_y = std::abs(last.y - cell.y);
  // Where along the line (0 to 1) the next border across each axis lies, and how far apart borders are.
  const double pace_x = left_x > 0 ? 1.0 / std::abs(dx) : 0.0;
  const double pace_y = left_y > 0 ? 1.0 / std::abs(dy) : 0.0;
  double next_x = (step_x > 0 ? cell.x + 1.0 - from_cells.x_m : from_cells.x_m - cell.x) * pace_x;
  double next_y = (step_y > 0 ? cell.y + 1.0 - from_cells.y_m : from_cells.y_m - cell.y) * pace_y;
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

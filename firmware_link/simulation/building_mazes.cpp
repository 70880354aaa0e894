// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "firmware_link/simulation/building_kinds.hpp"

namespace swiftlet {
namespace {

constexpr double kWallM = 0.1;

/// Cells in columns and rows, and which neighbours are connected: a spanning tree by depth-first search, and
/// some more, so that there are loops.
class Maze {
 public:
  struct Passage {
    int column;
    int row;
    bool is_upwards;  // to the next row, or to the next column
  };

  Maze(int columns, int rows, double loop_share, NoiseSource& noise)
      : columns_(columns), rows_(rows), is_known_(index(0, rows), false) {
    dig(0, 0, noise);
    for (int column = 0; column + 1 < columns; ++column)
      for (int row = 0; row + 1 < rows; ++row)
        if (noise.chance(loop_share)) passages_.push_back({column, row, noise.chance(0.5)});
  }
  [[nodiscard]] const std::vector<Passage>& passages() const { return passages_; }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  void dig(int column, int row, NoiseSource& noise) {
    is_known_[index(column, row)] = true;
    const int first = whole_between(noise, 0, 3);
    const int step = noise.chance(0.5) ? 1 : 3;
    for (int i = 0; i < 4; ++i) {
      const int side = (first + i * step) % 4;
      const int to_column = column + (side == 0 ? 1 : side == 2 ? -1 : 0);
      const int to_row = row + (side == 1 ? 1 : side == 3 ? -1 : 0);
      if (to_column < 0 || to_row < 0 || to_column >= columns_ || to_row >= rows_) continue;
      if (is_known_[index(to_column, to_row)]) continue;
      passages_.push_back({std::min(column, to_column), std::min(row, to_row), side % 2 == 1});
      dig(to_column, to_row, noise);
    }
  }

  int columns_;
  int rows_;
  std::vector<bool> is_known_;
  std::vector<Passage> passages_;
};

/// The rectangle from (x0, y0) to (x1, y1), bent around a centre `radius_m` below the origin; 0: not bent.
void add_bent(BuildingPlan& plan, double radius_m, double x0, double y0, double x1, double y1) {
  if (radius_m == 0.0) {
    plan.add_area(rectangle({}, x0, y0, x1, y1));
    return;
  }
  constexpr double kPieceM = 0.7;
  const int pieces = std::max(1, static_cast<int>((x1 - x0) / kPieceM));
  const auto bent = [&](double x, double y) {
    const double angle = kPi / 2.0 - x / radius_m;
    return Point2{(radius_m + y) * std::cos(angle), (radius_m + y) * std::sin(angle)};
  };
  const double piece_m = (x1 - x0) / pieces;
  for (int i = 0; i < pieces; ++i) {
    const double from = x0 + i * piece_m;
    const double to = from + piece_m + (i + 1 < pieces ? 0.02 : 0.0);
    plan.add_area({bent(from, y0), bent(to, y0), bent(to, y1), bent(from, y1)});
  }
}

}  // namespace

/// Square cells, or cells in rings.
BuildingPlan draw_maze(const BuildingWish& wish, NoiseSource& noise) {
  const double cell_m = noise.uniform(1.4, 2.4);
  const int columns = std::clamp(static_cast<int>(side_m(wish, noise) / cell_m), 3, 9);
  const int rows = std::clamp(static_cast<int>(columns * noise.uniform(0.5, 1.0)), 2, 8);
  const double angle = noise.uniform(1.5, 5.5);  // that the columns take
  const double radius_m =
      wish.directions == WallDirections::kOne ? 0.0 : std::max(columns * cell_m / angle, 1.2);
  const Maze maze(columns, rows, noise.uniform(0.0, 0.25), noise);
  BuildingPlan plan;
  constexpr double kHalfM = kWallM / 2.0;
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < rows; ++row)
      add_bent(plan, radius_m, column * cell_m + kHalfM, row * cell_m + kHalfM,
               (column + 1) * cell_m - kHalfM, (row + 1) * cell_m - kHalfM);
  for (const auto& [column, row, is_upwards] : maze.passages()) {
    const double x_m = column * cell_m;
    const double y_m = row * cell_m;
    if (is_upwards)
      add_bent(plan, radius_m, x_m + kHalfM, y_m + cell_m - 0.2, x_m + cell_m - kHalfM, y_m + cell_m + 0.2);
    else
      add_bent(plan, radius_m, x_m + cell_m - 0.2, y_m + kHalfM, x_m + cell_m + 0.2, y_m + cell_m - kHalfM);
  }
  return plan;
}

}  // namespace swiftlet

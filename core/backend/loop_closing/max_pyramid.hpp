// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/grid.hpp"

namespace swiftlet {

/// A byte grid with, on each level h, the maximum over the 2^h x 2^h cells that begin at a cell: the bounds
/// of branch and bound ("precomputed grids" of Hess et al. 2016, "Real-time loop closure in 2D lidar SLAM").
/// Several times the size of the grid, and built in less time than a search through it takes: made for one
/// search, not kept. Views the grid's cells, which must outlive it. Frozen once built.
class MaxPyramid {
 public:
  /// `cells` has geometry.cell_count() values, row by row. `levels` >= 1. Allocates.
  MaxPyramid(const GridGeometry& geometry, std::span<const std::uint8_t> cells, int levels);

  [[nodiscard]] int levels() const { return 1 + static_cast<int>(above_.size()); }
  /// The maximum over cells [x, x + 2^level) x [y, y + 2^level); cells outside the grid count as 0.
  [[nodiscard]] std::uint8_t max_at(int level, int x, int y) const {
    // A level's grid begins (2^h - 1) cells before the base grid, where blocks first touch it.
    const int reach = (1 << level) - 1;
    const int shifted_x = x + reach;
    const int shifted_y = y + reach;
    const int width = geometry_.width + reach;
    const int height = geometry_.height + reach;
    const auto is_inside = [](int at, int count) {  // negative ones are huge
      return static_cast<unsigned>(at) < static_cast<unsigned>(count);
    };
    if (!is_inside(shifted_x, width) || !is_inside(shifted_y, height)) return 0;
    const std::uint8_t* grid = level == 0 ? base_.data() : above_[static_cast<std::size_t>(level - 1)].data();
    return grid[static_cast<std::size_t>(shifted_y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(shifted_x)];
  }

 private:
  GridGeometry geometry_;
  std::span<const std::uint8_t> base_;
  std::vector<std::vector<std::uint8_t>> above_;  // levels 1 ...
};

/// Each cell becomes the maximum over the `width` x `width` cells around it (eq. 22). `width` odd.
std::vector<std::uint8_t> max_kernel(const GridGeometry& geometry, const std::vector<std::uint8_t>& cells,
                                     int width);

}  // namespace swiftlet

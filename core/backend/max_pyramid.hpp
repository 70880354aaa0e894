// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <vector>

#include "core/backend/grid_geometry.hpp"

namespace swiftlet {

/// A byte grid with, on each level h, the maximum over the 2^h x 2^h cells that begin at a cell: the bounds
/// of branch and bound ("precomputed grids" of Hess et al. 2016, "Real-time loop closure in 2D lidar SLAM").
/// Frozen once built.
class MaxPyramid {
 public:
  /// `cells` has geometry.cell_count() values, row by row. `levels` >= 1.
  MaxPyramid(const GridGeometry& geometry, std::vector<std::uint8_t> cells, int levels);

  [[nodiscard]] int levels() const { return static_cast<int>(grids_.size()); }
  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  /// The maximum over cells [x, x + 2^level) x [y, y + 2^level); cells outside the grid count as 0.
  [[nodiscard]] std::uint8_t max_at(int level, int x, int y) const {
    // A level's grid begins (2^h - 1) cells before the base grid, where blocks first touch it.
    const int reach = (1 << level) - 1;
    const int shifted_x = x + reach;
    const int shifted_y = y + reach;
    const int width = geometry_.width + reach;
    const int height = geometry_.height + reach;
    if (shifted_x < 0 || shifted_y < 0 || shifted_x >= width || shifted_y >= height) return 0;
    return grids_[static_cast<std::size_t>(level)]
                 [static_cast<std::size_t>(shifted_y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(shifted_x)];
  }

 private:
  GridGeometry geometry_;
  std::vector<std::vector<std::uint8_t>> grids_;
};

/// Each cell becomes the maximum over the `width` x `width` cells around it (eq. 22). `width` odd.
std::vector<std::uint8_t> max_kernel(const GridGeometry& geometry, const std::vector<std::uint8_t>& cells,
                                     int width);

}  // namespace swiftlet

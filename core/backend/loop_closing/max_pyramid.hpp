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
    return Level(*this, level).max_at(x, y);
  }
  /// The sum of the maxima at all of `cells` moved by (x, y); less, and less than `at_least`, where it would
  /// be less than that.
  [[nodiscard]] std::uint32_t sum(int level, std::span<const CellIndex> cells, int x, int y,
                                  std::uint32_t at_least) const;

 private:
  /// Begins (2^level - 1) cells before the base grid, where blocks first touch it.
  class Level {
   public:
    Level(const MaxPyramid& pyramid, int level)
        : reach_((1 << level) - 1),
          width_(static_cast<unsigned>(pyramid.geometry_.width + reach_)),
          height_(static_cast<unsigned>(pyramid.geometry_.height + reach_)),
          grid_(level == 0 ? pyramid.base_.data()
                           : pyramid.above_[static_cast<std::size_t>(level - 1)].data()) {}
    [[nodiscard]] std::uint8_t max_at(int x, int y) const {
      const auto shifted_x = static_cast<unsigned>(x + reach_);  // negative ones are huge
      const auto shifted_y = static_cast<unsigned>(y + reach_);
      if (shifted_x >= width_ || shifted_y >= height_) return 0;
      return grid_[std::size_t{shifted_y} * width_ + shifted_x];
    }

   private:
    int reach_;
    unsigned width_;
    unsigned height_;
    const std::uint8_t* grid_;
  };

  GridGeometry geometry_;
  std::span<const std::uint8_t> base_;
  std::vector<std::vector<std::uint8_t>> above_;  // levels 1 ...
};

/// Each cell becomes the maximum over the `width` x `width` cells around it (eq. 22). `width` odd.
std::vector<std::uint8_t> max_kernel(const GridGeometry& geometry, const std::vector<std::uint8_t>& cells,
                                     int width);

}  // namespace swiftlet

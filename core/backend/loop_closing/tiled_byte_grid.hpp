// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/grid.hpp"

namespace swiftlet {

/// A byte grid for summing what lies under many points, at 8 x 8 positions of the points at once: eight bytes
/// of a row are added in one go, which is many times faster than one position after the other. Holds a copy
/// of the grid. Frozen once built.
class TiledByteGrid {
 public:
  static constexpr int kSide = 8;
  using Sums = std::array<std::uint32_t, std::size_t{kSide} * kSide>;  ///< row by row

  /// `bytes` has geometry.cell_count() values, row by row. Positions lie `stride` cells apart, a
  /// power of two. Allocates.
  TiledByteGrid(const GridGeometry& geometry, std::span<const std::uint8_t> bytes, int stride);

  /// The sums with all of `cells` moved by (x + stride * column, y + stride * row). Outside the grid is 0.
  /// Where none of them would be `at_least` they are less than that, and may be 0.
  [[nodiscard]] Sums sums(std::span<const CellIndex> cells, int x, int y, std::uint32_t at_least = 0) const;
  /// The same on any machine: sums() takes wider vectors where there are some.
  [[nodiscard]] Sums sums_portable(std::span<const CellIndex> cells, int x, int y,
                                   std::uint32_t at_least = 0) const;

 private:
  template <typename Rows>
  [[nodiscard]] Sums sums_of(std::span<const CellIndex> cells, int x, int y, std::uint32_t at_least) const;
  [[nodiscard]] Sums sums_avx2(std::span<const CellIndex> cells, int x, int y, std::uint32_t at_least) const;
  [[nodiscard]] const std::uint8_t* tile_at(int x, int y) const;

  [[nodiscard]] std::size_t offset(int x, int y) const;

  int shift_;    // bits of the stride
  int columns_;  // of a plane, with a margin on both sides
  int rows_;
  std::vector<std::uint8_t> planes_;  // every stride-th column and row, by where they begin
};

}  // namespace swiftlet

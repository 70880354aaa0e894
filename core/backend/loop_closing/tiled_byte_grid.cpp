// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/tiled_byte_grid.hpp"

#include <algorithm>

#include "core/base/check.hpp"

namespace swiftlet {
namespace {

constexpr int kMargin = TiledByteGrid::kSide - 1;  // tiles that touch the grid with their last row or column
constexpr std::size_t kCellsAtOnce = 64;           // whose bytes add up to less than 16 bits hold

}  // namespace

TiledByteGrid::TiledByteGrid(const GridGeometry& geometry, std::span<const std::uint8_t> bytes, int stride)
    : stride_(stride),
      columns_((geometry.width + stride - 1) / stride + 2 * kMargin),
      rows_((geometry.height + stride - 1) / stride + 2 * kMargin) {
  SWIFTLET_CHECK(stride == 1 || stride == 2, "positions lie one or two cells apart");
  SWIFTLET_CHECK(bytes.size() == geometry.cell_count(), "the bytes fill the grid");
  planes_.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(stride));
  for (auto& plane : planes_)
    plane.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const int plane = stride * (y % stride) + x % stride;
      const int at = (y / stride + kMargin) * columns_ + x / stride + kMargin;
      planes_[static_cast<std::size_t>(plane)][static_cast<std::size_t>(at)] = bytes[geometry.offset({x, y})];
    }
  }
}

/// Where the tile that begins at a cell begins in its plane; null where it lies outside.
const std::uint8_t* TiledByteGrid::tile_at(int x, int y) const {
  const int shift = stride_ - 1;  // of negative numbers rounds down, unlike a division
  const int column = (x >> shift) + kMargin;
  const int row = (y >> shift) + kMargin;
  if (column < 0 || row < 0 || column > columns_ - kSide || row > rows_ - kSide) return nullptr;
  const int plane = stride_ * (y & shift) + (x & shift);
  const int at = row * columns_ + column;
  return planes_[static_cast<std::size_t>(plane)].data() + at;
}

TiledByteGrid::Sums TiledByteGrid::sums(std::span<const CellIndex> cells, int x, int y,
                                        std::uint32_t at_least) const {
  Sums sums{};
  while (!cells.empty() && *std::max_element(sums.begin(), sums.end()) + 255 * cells.size() >= at_least) {
    const auto some = cells.first(std::min(cells.size(), kCellsAtOnce));
    cells = cells.subspan(some.size());
    std::array<std::uint16_t, sums.size()> partial{};
    for (const CellIndex& cell : some) {
      const std::uint8_t* row = tile_at(cell.x + x, cell.y + y);
      if (row == nullptr) continue;
      for (std::size_t k = 0; k < partial.size(); k += kSide, row += columns_) {
        for (std::size_t i = 0; i < kSide; ++i)
          partial[k + i] = static_cast<std::uint16_t>(partial[k + i] + row[i]);
      }
    }
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += partial[k];
  }
  return sums;
}

}  // namespace swiftlet

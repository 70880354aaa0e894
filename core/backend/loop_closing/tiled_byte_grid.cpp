// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/tiled_byte_grid.hpp"

#include <algorithm>
#include <cstring>

#include "core/base/check.hpp"
#include "core/base/processor.hpp"

namespace swiftlet {
namespace {

constexpr int kMargin = TiledByteGrid::kSide - 1;  // tiles that touch the grid with their last row or column
constexpr std::size_t kCellsOfWords = 256;         // whose bytes add up to less than 16 bits hold
constexpr std::size_t kCellsAtOnce = 32;           // between two looks at what can still be reached
constexpr std::size_t kRow = TiledByteGrid::kSide;

/// Sums of one row of a tile or of two, by extensions of GCC and clang that compile for any machine.
struct OneRow {
  using Bytes = std::uint8_t __attribute__((vector_size(kRow)));
  using Words = std::uint16_t __attribute__((vector_size(2 * kRow)));
};
struct TwoRows {
  using Bytes = std::uint8_t __attribute__((vector_size(2 * kRow)));
  using Words = std::uint16_t __attribute__((vector_size(4 * kRow)));
};

/// The tiles under some cells, added up.
template <typename Rows>
struct TileSums {
  static constexpr std::size_t kRowsAtOnce = sizeof(typename Rows::Bytes) / kRow;
  typename Rows::Words words[kRow / kRowsAtOnce]{};

  /// `tile`: its first row; the next begins `stride` bytes later.
  [[gnu::always_inline]] void add(const std::uint8_t* tile, std::ptrdiff_t stride) {
    for (auto& sum : words) {
      std::uint8_t rows[sizeof(typename Rows::Bytes)];
      for (std::size_t row = 0; row < kRowsAtOnce; ++row, tile += stride)
        std::memcpy(rows + row * kRow, tile, kRow);
      typename Rows::Bytes bytes;
      std::memcpy(&bytes, rows, sizeof bytes);
      sum += __builtin_convertvector(bytes, typename Rows::Words);
    }
  }
  [[nodiscard, gnu::always_inline]] std::uint32_t largest() const {
    typename Rows::Words most = words[0];
    for (const auto& sum : words) most = sum > most ? sum : most;
    std::uint16_t result = 0;
    for (std::size_t i = 0; i < kRowsAtOnce * kRow; ++i) result = std::max(result, std::uint16_t{most[i]});
    return result;
  }
  [[gnu::always_inline]] void add_to(TiledByteGrid::Sums& sums) const {
    std::array<std::uint16_t, std::tuple_size_v<TiledByteGrid::Sums>> each;
    std::memcpy(each.data(), words, sizeof words);
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += each[k];
  }
};

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

template <typename Rows>
[[gnu::always_inline]] inline TiledByteGrid::Sums TiledByteGrid::sums_of(std::span<const CellIndex> cells,
                                                                         int x, int y,
                                                                         std::uint32_t at_least) const {
  Sums sums{};
  while (!cells.empty()) {
    auto some = cells.first(std::min(cells.size(), kCellsOfWords));
    cells = cells.subspan(some.size());
    const std::uint32_t before = *std::max_element(sums.begin(), sums.end());
    TileSums<Rows> partial;
    while (!some.empty()) {
      if (before + partial.largest() + 255 * (some.size() + cells.size()) < at_least) return {};
      const auto next = some.first(std::min(some.size(), kCellsAtOnce));
      some = some.subspan(next.size());
      for (const CellIndex& cell : next)
        if (const std::uint8_t* tile = tile_at(cell.x + x, cell.y + y)) partial.add(tile, columns_);
    }
    partial.add_to(sums);
  }
  return sums;
}

#if SWIFTLET_MAY_HAVE_AVX2
[[gnu::target("avx2")]] TiledByteGrid::Sums TiledByteGrid::sums_avx2(std::span<const CellIndex> cells, int x,
                                                                     int y, std::uint32_t at_least) const {
  return sums_of<TwoRows>(cells, x, y, at_least);
}

TiledByteGrid::Sums TiledByteGrid::sums(std::span<const CellIndex> cells, int x, int y,
                                        std::uint32_t at_least) const {
  return has_avx2() ? sums_avx2(cells, x, y, at_least) : sums_portable(cells, x, y, at_least);
}
#else
TiledByteGrid::Sums TiledByteGrid::sums(std::span<const CellIndex> cells, int x, int y,
                                        std::uint32_t at_least) const {
  return sums_portable(cells, x, y, at_least);
}
#endif

TiledByteGrid::Sums TiledByteGrid::sums_portable(std::span<const CellIndex> cells, int x, int y,
                                                 std::uint32_t at_least) const {
  return sums_of<OneRow>(cells, x, y, at_least);
}

}  // namespace swiftlet

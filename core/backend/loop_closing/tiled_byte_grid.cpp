// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/tiled_byte_grid.hpp"

#include <algorithm>
#include <bit>
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
    : shift_(std::countr_zero(static_cast<unsigned>(stride))),
      columns_(((geometry.width + stride - 1) >> shift_) + 2 * kMargin),
      rows_(((geometry.height + stride - 1) >> shift_) + 2 * kMargin),
      planes_((static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) << (2 * shift_), 0) {
  SWIFTLET_CHECK(std::has_single_bit(static_cast<unsigned>(stride)), "positions lie 1, 2, 4 ... cells apart");
  SWIFTLET_CHECK(bytes.size() == geometry.cell_count(), "the bytes fill the grid");
  auto byte = bytes.begin();
  for (int y = 0; y < geometry.height; ++y)
    for (int x = 0; x < geometry.width; ++x) planes_[offset(x, y)] = *byte++;
}

/// Of a cell of the grid or of a margin; each plane holds the columns and rows that lie `stride` apart.
std::size_t TiledByteGrid::offset(int x, int y) const {
  const int mask = (1 << shift_) - 1;  // of negative numbers too: shifts round down, unlike divisions
  const int plane = ((y & mask) << shift_) + (x & mask);
  const int row = plane * rows_ + (y >> shift_) + kMargin;
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>((x >> shift_) + kMargin);
}

/// Where the tile that begins at a cell begins in its plane; null where it lies outside.
const std::uint8_t* TiledByteGrid::tile_at(int x, int y) const {
  const int column = (x >> shift_) + kMargin;
  const int row = (y >> shift_) + kMargin;
  if (column < 0 || row < 0 || column > columns_ - kSide || row > rows_ - kSide) return nullptr;
  return planes_.data() + offset(x, y);
}

template <typename Rows>
[[gnu::always_inline]] inline TiledByteGrid::Sums TiledByteGrid::sums_of(std::span<const CellIndex> cells,
                                                                         int x, int y,
                                                                         std::uint32_t at_least) const {
  Sums sums{};
  std::uint32_t before = 0;  // the largest
  while (!cells.empty()) {
    auto some = cells.first(std::min(cells.size(), kCellsOfWords));
    cells = cells.subspan(some.size());
    TileSums<Rows> partial;
    while (!some.empty()) {
      if (before + partial.largest() + 255 * (some.size() + cells.size()) < at_least) return {};
      const auto next = some.first(std::min(some.size(), kCellsAtOnce));
      some = some.subspan(next.size());
      for (const CellIndex& cell : next)
        if (const std::uint8_t* tile = tile_at(cell.x + x, cell.y + y)) partial.add(tile, columns_);
    }
    partial.add_to(sums);
    if (!cells.empty()) before = *std::max_element(sums.begin(), sums.end());
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

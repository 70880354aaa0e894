// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/grid.hpp"

namespace swiftlet {

/// Numbers the square cells that points fall into, in the order of their first points: for thinning. A hash
/// table with open addressing. Allocates in reset() and keeps its memory.
class CellNumbers {
 public:
  explicit CellNumbers(double cell_m) : cell_m_(cell_m) {}

  /// Removes all cells and makes room for so many.
  void reset(std::size_t max_cells) {
    slots_.assign(std::bit_ceil(2 * max_cells + 2), Slot{});
    count_ = 0;
  }
  /// Precondition: no more cells than reset() made room for.
  std::uint32_t number_of(const Point2& p) {
    const CellIndex at_p = cell_of(p, cell_m_);
    const std::uint64_t cell =
        (std::uint64_t{static_cast<std::uint32_t>(at_p.x)} << 32U) | static_cast<std::uint32_t>(at_p.y);
    std::uint64_t at = (cell * 0x9E3779B97F4A7C15U) >> 32U;  // multiplicative hashing (Knuth 1998, 6.4)
    for (;; ++at) {
      Slot& slot = slots_[at & (slots_.size() - 1)];
      if (slot.number == kEmpty) slot = {cell, count_++};
      if (slot.cell == cell) return slot.number;
    }
  }
  /// Whether the point is the first of its cell.
  bool is_first(const Point2& p) {
    const std::uint32_t before = count_;
    return number_of(p) == before;
  }
  [[nodiscard]] std::size_t size() const { return count_; }

 private:
  static constexpr std::uint32_t kEmpty = ~std::uint32_t{0};
  struct Slot {
    std::uint64_t cell = 0;
    std::uint32_t number = kEmpty;
  };

  double cell_m_;
  std::vector<Slot> slots_;
  std::uint32_t count_ = 0;
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/grid.hpp"

namespace swiftlet {

/// Numbers the square cells that points fall into, in the order in which they are first met: for thinning. A
/// hash table of open addresses. Allocates in reset(), and keeps what it has.
class CellNumbers {
 public:
  explicit CellNumbers(double cell_m) : cell_m_(cell_m) {}

  /// Forgets all cells; there will be at most so many.
  void reset(std::size_t most) {
    slots_.assign(std::bit_ceil(2 * most + 2), Slot{});
    count_ = 0;
  }
  /// Precondition: not more cells than reset() was told.
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
  /// Whether the point's cell was not met before.
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

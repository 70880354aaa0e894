// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/base/index_removal.hpp"

namespace swiftlet {

/// Visits all elements of a growing sequence once, some now and some later, each time from where it ended.
class RoundRobin {
 public:
  /// Each of `count` elements is due, whether it was already or not.
  void begin(std::size_t count) { due_ = count; }
  [[nodiscard]] bool is_done() const { return due_ == 0; }
  /// The element whose turn it is, of `count`. Precondition: not done.
  std::size_t take(std::size_t count) {
    if (next_ >= count) next_ = 0;
    --due_;
    return next_++;
  }
  /// Elements are removed from the sequence, which had `count`. Of the others the same stay due.
  void remove(const IndexRemoval& removed, std::size_t count) {
    const auto new_index = [&removed](std::size_t i) -> std::size_t {
      return removed.new_index(static_cast<std::uint32_t>(i));
    };
    const std::size_t end = next_ + due_;
    const std::size_t from_start = end > count ? new_index(end - count) : 0;
    due_ = new_index(std::min(end, count)) - new_index(next_) + from_start;
    next_ = new_index(next_);
  }

 private:
  std::size_t next_ = 0;
  std::size_t due_ = 0;
};

}  // namespace swiftlet

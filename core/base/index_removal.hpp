// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/check.hpp"

namespace swiftlet {

/// Consecutive indices.
struct IndexRange {
  std::uint32_t first = 0;
  std::uint32_t end = 0;  ///< one behind the last
  [[nodiscard]] std::uint32_t size() const { return end - first; }
};

/// What is taken out of sequences that share an index, and where the rest moves up to. Allocates.
class IndexRemoval {
 public:
  /// Precondition: the range begins at or behind the end of the one before it. An empty one changes nothing.
  void add(IndexRange range) {
    if (range.size() == 0) return;
    SWIFTLET_CHECK(holes_.empty() || range.first >= holes_.back().range.end, "ranges are in order");
    if (!holes_.empty() && range.first == holes_.back().range.end) {
      holes_.back().range.end = range.end;
    } else {
      holes_.push_back({range, size()});
    }
  }

  /// How many indices are taken out.
  [[nodiscard]] std::uint32_t size() const {
    return holes_.empty() ? 0 : holes_.back().removed_before + holes_.back().range.size();
  }
  [[nodiscard]] bool removes(std::uint32_t index) const {
    const std::size_t after = holes_behind(index);
    return after > 0 && index < holes_[after - 1].range.end;
  }
  /// Where what is kept at `index` moves to; of what is removed, where the next that is kept does.
  [[nodiscard]] std::uint32_t new_index(std::uint32_t index) const {
    const std::size_t after = holes_behind(index);
    if (after == 0) return index;
    const Hole& hole = holes_[after - 1];
    return std::max(index, hole.range.end) - hole.removed_before - hole.range.size();
  }
  /// Takes the elements out of a sequence that has this index.
  template <typename T>
  void apply(std::vector<T>& sequence) const {
    if (holes_.empty()) return;
    const auto at = [&sequence](std::uint32_t index) {
      return sequence.begin() + static_cast<std::ptrdiff_t>(index);
    };
    auto to = at(holes_.front().range.first);
    for (std::size_t i = 0; i < holes_.size(); ++i) {
      const auto end = i + 1 < holes_.size() ? at(holes_[i + 1].range.first) : sequence.end();
      to = std::move(at(holes_[i].range.end), end, to);
    }
    sequence.erase(to, sequence.end());
  }
  /// The ranges, merged where they touched, in order.
  [[nodiscard]] std::vector<IndexRange> ranges() const {
    std::vector<IndexRange> ranges;
    for (const Hole& hole : holes_) ranges.push_back(hole.range);
    return ranges;
  }

 private:
  struct Hole {
    IndexRange range;
    std::uint32_t removed_before = 0;
  };
  /// How many holes begin at or before the index.
  [[nodiscard]] std::size_t holes_behind(std::uint32_t index) const {
    const auto after =
        std::upper_bound(holes_.begin(), holes_.end(), index,
                         [](std::uint32_t i, const Hole& hole) { return i < hole.range.first; });
    return static_cast<std::size_t>(after - holes_.begin());
  }

  std::vector<Hole> holes_;
};

}  // namespace swiftlet

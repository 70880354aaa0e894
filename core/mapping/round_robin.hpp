// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/base/id_map.hpp"

namespace swiftlet {

/// Visits the ids of a growing map once, some now and some later, each time from where it ended.
template <AnId Id>
class RoundRobin {
 public:
  /// All ids are due, whether they were already or not.
  template <typename T>
  void begin(const IdMap<Id, T>& all) {
    due_ = all.size();
    end_ = all.end_id();
  }
  [[nodiscard]] bool is_done() const { return due_ == 0; }
  /// The id whose turn it is. Precondition: not done.
  template <typename T>
  Id take(const IdMap<Id, T>& all) {
    next_ = all.at_or_after(next_);
    if (next_ >= end_) next_ = all.first_id();
    --due_;
    const Id taken = next_;
    ++next_;
    return taken;
  }
  /// Ids are about to be erased from the map. Of the others the same stay due.
  template <typename T>
  void erase(const IdRanges<Id>& gone, const IdMap<Id, T>& all) {
    const std::size_t begin = all.position(next_);
    const std::size_t size = all.position(end_);
    const std::size_t end = std::min(begin + due_, size);
    const std::size_t wrapped_end = begin + due_ - end;  // due are those before it, too
    std::size_t erased = 0;
    for (const IdRange<Id>& range : gone) {
      const std::size_t first = all.position(range.first);
      const std::size_t last = all.position(range.end);
      erased += std::min(last, end) - std::min(std::max(first, begin), std::min(last, end));
      erased += std::min(last, wrapped_end) - std::min(first, wrapped_end);
    }
    due_ -= erased;
  }

 private:
  Id next_{};
  Id end_{};  // of those that are due: later ones were added since
  std::size_t due_ = 0;
};

}  // namespace swiftlet

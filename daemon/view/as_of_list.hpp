// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace swiftlet {

/// How something has changed with time, so that it can be looked up as it was. One thread at a time.
template <typename Value>
class AsOfList {
 public:
  struct Entry {
    std::int64_t utime_us = 0;
    std::uint32_t serial = 0;  ///< counts up from 1 with each append
    Value value{};
  };

  /// A time before the newest entry's counts as that entry's time.
  void append(std::int64_t utime_us, Value value) {
    if (!entries_.empty()) utime_us = std::max(utime_us, entries_.back().utime_us);
    entries_.push_back({utime_us, ++serial_, std::move(value)});
  }
  /// As append(), but in the place of the newest where that follows its own predecessor by less than
  /// `spacing_us`. replaceable() tells beforehand which value goes.
  void append_spaced(std::int64_t utime_us, Value value, std::int64_t spacing_us) {
    if (replaceable(utime_us, spacing_us) != nullptr) entries_.pop_back();
    append(utime_us, std::move(value));
  }
  [[nodiscard]] const Value* replaceable(std::int64_t utime_us, std::int64_t spacing_us) const {
    if (entries_.size() < 2) return nullptr;
    const bool is_near = utime_us - entries_[entries_.size() - 2].utime_us < spacing_us;
    return is_near ? &entries_.back().value : nullptr;
  }
  /// The newest that is not after `utime_us`; nullptr when all are. Valid until the next change.
  [[nodiscard]] const Entry* at(std::int64_t utime_us) const {
    const auto after =
        std::upper_bound(entries_.begin(), entries_.end(), utime_us,
                         [](std::int64_t time_us, const Entry& entry) { return time_us < entry.utime_us; });
    return after == entries_.begin() ? nullptr : &*(after - 1);
  }
  [[nodiscard]] const Entry* newest() const { return entries_.empty() ? nullptr : &entries_.back(); }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

  /// Forgets every second entry but the oldest and the newest; calls `forget` with each that goes.
  template <typename Forget>
  void thin(Forget forget) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      if (i % 2 == 1 && i + 1 < entries_.size())
        forget(entries_[i].value);
      else if (kept++ != i)
        entries_[kept - 1] = std::move(entries_[i]);
    }
    entries_.resize(kept);
  }

 private:
  std::vector<Entry> entries_;
  std::uint32_t serial_ = 0;
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/monotonic_time.hpp"
#include "daemon/view/run_history.hpp"
#include "daemon/view/run_narrator.hpp"

namespace swiftlet {

/// The channels that a MessageReader reads, without their prefix.
[[nodiscard]] std::span<const std::string_view> viewed_channels();

/// Reads the messages of docs/lcm.md into a RunHistory. What cannot be decoded, or holds what no daemon says,
/// is ignored. One thread at a time.
class MessageReader {
 public:
  /// `history` must outlive the reader.
  explicit MessageReader(RunHistory& history) : history_(history), narrator_(history) {}

  /// A message on `channel` (without prefix), received at `now`.
  void take(std::string_view channel, std::span<const std::uint8_t> message, MonotonicTime now);

 private:
  RunHistory& history_;
  RunNarrator narrator_;
  MonotonicTime last_accepted_{};
  std::vector<SeenWall> walls_;  // of the parts so far

  template <typename Message>
  void decode(std::span<const std::uint8_t> bytes, MonotonicTime now);
  template <typename Message>
  void add(const Message& message);
};

}  // namespace swiftlet

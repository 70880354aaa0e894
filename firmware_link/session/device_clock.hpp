// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstdint>

#include "core/base/time.hpp"

namespace swiftlet {

/// Unwraps the 24-bit millisecond counter of log packets, which wraps every 4 h 39 min. A step of less than
/// half that span is forward, any other is backward: packets of two blocks may overtake each other, and a
/// vehicle may reboot. One thread at a time; allocates nothing.
class DeviceClockUnwrapper {
 public:
  /// The first counter value is the time since boot, if that was less than one span ago.
  DeviceTime unwrap(std::uint32_t counter_ms) {
    const std::uint32_t counter = counter_ms & kMask;
    if (!started_) {
      started_ = true;
      last_ms_ = counter;
    } else {
      last_ms_ += shortest_step_ms(std::int64_t{counter} - last_ms_);
    }
    return DeviceTime(std::chrono::milliseconds(last_ms_));
  }

  /// The step of at most half a span, either way, that looks like `step_ms` on a counter that wraps.
  static constexpr std::int64_t shortest_step_ms(std::int64_t step_ms) {
    const std::int64_t forward = step_ms & kMask;
    return forward >= kSpan / 2 ? forward - kSpan : forward;
  }

 private:
  static constexpr std::uint32_t kMask = 0xFFFFFF;
  static constexpr std::int64_t kSpan = std::int64_t{1} << 24;
  bool started_ = false;
  std::int64_t last_ms_ = 0;
};

}  // namespace swiftlet

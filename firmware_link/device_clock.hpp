// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstdint>

#include "core/base/time.hpp"

namespace swiftlet {

/// Makes one running time of the 24-bit millisecond counter in log packets, which wraps every 4 h 39 min. A
/// step of less than half that span is forward, any other is backward: packets of two blocks may arrive
/// crosswise, and a vehicle may reboot. One thread at a time; allocates nothing.
class DeviceClockUnwrapper {
 public:
  /// The first counter value is taken as it is: time since boot, if that was less than one span ago.
  DeviceTime unwrap(std::uint32_t counter_ms) {
    const std::uint32_t counter = counter_ms & kMask;
    if (!started_) {
      started_ = true;
      last_ms_ = counter;
    } else {
      const std::uint32_t forward = (counter - static_cast<std::uint32_t>(last_ms_ & kMask)) & kMask;
      last_ms_ += forward;
      if (forward >= kHalfSpan) last_ms_ -= kSpan;
    }
    return DeviceTime(std::chrono::milliseconds(last_ms_));
  }

 private:
  static constexpr std::uint32_t kMask = 0xFFFFFF;
  static constexpr std::uint32_t kHalfSpan = 1U << 23;
  static constexpr std::int64_t kSpan = std::int64_t{1} << 24;
  bool started_ = false;
  std::int64_t last_ms_ = 0;
};

}  // namespace swiftlet

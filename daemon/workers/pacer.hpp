// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <chrono>

#include "core/base/check.hpp"
#include "core/base/time.hpp"
#include "daemon/system/clock.hpp"

namespace swiftlet {

/// Gives a recording its own pace back: how far apart the samples' stamps are decides how far apart they are
/// due, `rate` times as fast. The first is due at once; a stamp that goes back waits for nothing, and one
/// that leaps ahead (a clock that was set, a vehicle that stood for hours) for no more than kLongestPause.
class Pacer {
 public:
  static constexpr Duration kLongestPause = std::chrono::minutes(1);  ///< as recorded

  /// Precondition: rate > 0.
  explicit Pacer(double rate) : rate_(rate) {
    SWIFTLET_CHECK(rate > 0.0, "the rate of a replay is positive");
  }

  /// When the sample stamped `stamp` is due. Call once for each sample, in order.
  MonotonicTime due(HostTime stamp, MonotonicTime now) noexcept {
    if (!started_) {
      started_ = true;
      due_ = now;
    } else {
      const Duration apart = std::clamp(stamp - last_stamp_, Duration(0), kLongestPause);
      due_ += from_seconds(to_seconds(apart) / rate_);
    }
    last_stamp_ = stamp;
    return due_;
  }

 private:
  double rate_;
  bool started_ = false;
  HostTime last_stamp_{};
  MonotonicTime due_{};
};

}  // namespace swiftlet

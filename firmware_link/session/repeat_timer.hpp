// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "core/base/time.hpp"

namespace swiftlet {

/// How long to wait for an answer before a request is repeated, from measured round trips: V. Paxson et al.,
/// "Computing TCP's Retransmission Timer", RFC 6298, sections 2 and 5, with limits of our own. No clock.
class RepeatTimer {
 public:
  /// Before anything is measured.
  static constexpr Duration kInitial = std::chrono::milliseconds(200);
  static constexpr Duration kShortest = std::chrono::milliseconds(20);
  static constexpr Duration kLongest = std::chrono::seconds(1);

  [[nodiscard]] Duration wait() const { return wait_; }
  /// Of a request that was sent once: it is unknown which transmission of a repeated one was answered.
  void on_round_trip(Duration measured) {
    if (!smoothed_) {
      smoothed_ = measured;
      variation_ = measured / 2;
    } else {
      const Duration difference = std::max(*smoothed_ - measured, measured - *smoothed_);
      variation_ += (difference - variation_) / 4;
      *smoothed_ += (measured - *smoothed_) / 8;
    }
    wait_ = std::clamp(*smoothed_ + 4 * variation_, kShortest, kLongest);
  }
  /// A request is repeated: until the next measurement, wait longer.
  void on_repetition() { wait_ = std::min(2 * wait_, kLongest); }

 private:
  std::optional<Duration> smoothed_;
  Duration variation_{0};
  Duration wait_ = kInitial;
};

}  // namespace swiftlet

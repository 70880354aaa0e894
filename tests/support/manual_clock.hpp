// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <atomic>

#include "daemon/system/clock.hpp"

namespace swiftlet {

/// Time that a test moves, or a sleep, which returns at once. Any thread.
class ManualClock final : public Clock {
 public:
  [[nodiscard]] MonotonicTime now() const override { return MonotonicTime(now_.load()); }
  void sleep_until(MonotonicTime wake_at) override {
    MonotonicTime::duration seen = now_.load();
    while (wake_at.time_since_epoch() > seen &&
           !now_.compare_exchange_weak(seen, wake_at.time_since_epoch())) {
    }
  }
  /// Rung or not: all the time passes.
  void wait_for(EventCount& /*event_count*/, std::uint32_t /*received*/, MonotonicTime wake_at) override {
    sleep_until(wake_at);
  }
  void advance(MonotonicTime::duration by) { now_.store(now_.load() + by); }

 private:
  std::atomic<MonotonicTime::duration> now_{MonotonicTime::duration(0)};
};

}  // namespace swiftlet

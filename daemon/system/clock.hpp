// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstdint>
#include <thread>

#include "core/base/monotonic_time.hpp"
#include "daemon/system/event_count.hpp"

namespace swiftlet {

/// The only way workers ask for the time, so that tests can stop it. Any thread.
class Clock {
 public:
  Clock() = default;
  virtual ~Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;

  [[nodiscard]] virtual MonotonicTime now() const = 0;
  virtual void sleep_until(MonotonicTime wake_at) = 0;
  /// As EventCount::wait().
  virtual void wait_for(EventCount& event_count, std::uint32_t received, MonotonicTime wake_at) = 0;
};

class SteadyClock final : public Clock {
 public:
  [[nodiscard]] MonotonicTime now() const override { return std::chrono::steady_clock::now(); }
  void sleep_until(MonotonicTime wake_at) override { std::this_thread::sleep_until(wake_at); }
  void wait_for(EventCount& event_count, std::uint32_t received, MonotonicTime wake_at) override {
    event_count.wait(received, wake_at);
  }
};

}  // namespace swiftlet

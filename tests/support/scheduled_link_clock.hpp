// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <poll.h>
#include <algorithm>
#include <functional>
#include <map>
#include <span>
#include <utility>

#include "firmware_link/link/link_clock.hpp"

namespace swiftlet {

/// Time that a test moves, or a sleep; what is to happen on the way happens at its
/// instant. One thread at a time.
class ScheduledLinkClock final : public LinkClock {
 public:
  /// Told of every step of time, before the events at its end.
  std::function<void(Duration)> on_step;

  [[nodiscard]] HostTime now() override { return now_; }
  void sleep_for(Duration duration) override { advance(duration); }
  /// In steps: what is to happen on the way may write the file.
  void sleep_until_readable(std::span<const int> files, Duration duration) override {
    constexpr Duration kStep = std::chrono::microseconds(100);
    for (const HostTime end = now_ + duration; now_ < end && !is_readable(files);)
      advance(std::min(kStep, end - now_));
  }
  /// Rounds up to whole microseconds.
  void advance(Duration by) {
    const HostTime end = now_ + std::chrono::ceil<std::chrono::microseconds>(std::max(by, Duration::zero()));
    while (!events_.empty() && events_.begin()->first <= end) {
      const auto event = events_.extract(events_.begin());
      step_to(std::max(now_, event.key()));
      event.mapped()();
    }
    step_to(end);
  }
  /// Has something happen that much later.
  void after(Duration delay, std::function<void()> event) { events_.emplace(now_ + delay, std::move(event)); }

 private:
  static bool is_readable(std::span<const int> files) {
    return std::ranges::any_of(files, [](int file) {
      pollfd watched{.fd = file, .events = POLLIN, .revents = 0};
      return ::poll(&watched, 1, 0) > 0;
    });
  }
  void step_to(HostTime to) {
    const Duration by = to - now_;
    now_ = to;
    if (on_step && by > Duration::zero()) on_step(by);
  }

  HostTime now_{std::chrono::seconds(1'767'225'600)};  // 2026-01-01 00:00:00 UTC
  std::multimap<HostTime, std::function<void()>> events_;
};

}  // namespace swiftlet

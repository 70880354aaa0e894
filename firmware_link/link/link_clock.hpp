// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <poll.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <ctime>
#include <span>
#include <thread>

#include "core/base/check.hpp"
#include "core/base/monotonic_time.hpp"
#include "core/base/time.hpp"

namespace swiftlet {

/// The time of live links: stamps of frames, time-outs and pauses between polls. Injected, so that tests and
/// simulated dongles can make their own. One thread at a time.
class LinkClock {
 public:
  LinkClock() = default;
  virtual ~LinkClock() = default;
  LinkClock(const LinkClock&) = delete;
  LinkClock& operator=(const LinkClock&) = delete;

  /// Unix time in whole microseconds, as a recording keeps it; never goes back.
  [[nodiscard]] virtual HostTime now() = 0;
  /// The time that long ago by the machine's clock. Simulated time has not passed meanwhile.
  [[nodiscard]] virtual HostTime ago(Duration /*past*/) { return now(); }
  /// What the machine's monotonic clock showed at `at`, a time that now() has passed. Simulated time: shows
  /// now.
  [[nodiscard]] virtual MonotonicTime monotonic_time_of(HostTime /*at*/) {
    return std::chrono::steady_clock::now();
  }
  virtual void sleep_for(Duration duration) = 0;
  /// Sleeps for that long, or until there is something to read in one of `files`, at most kMaxFiles; negative
  /// ones are none. Simulated time passes whole.
  virtual void sleep_until_readable(std::span<const int> /*files*/, Duration duration) {
    sleep_for(duration);
  }
  static constexpr std::size_t kMaxFiles = 2;
};

/// Unix time as it was at the start, continued by the monotonic clock: a correction of the machine's clock
/// during a flight does not change the stamps.
class SystemLinkClock final : public LinkClock {
 public:
  [[nodiscard]] HostTime now() override {
    const auto elapsed = std::chrono::steady_clock::now() - steady_start_;
    return HostTime(std::chrono::floor<std::chrono::microseconds>(unix_start_ + elapsed));
  }
  [[nodiscard]] HostTime ago(Duration past) override {
    return std::chrono::floor<std::chrono::microseconds>(now() - past);
  }
  [[nodiscard]] MonotonicTime monotonic_time_of(HostTime at) override {
    return steady_start_ + (at.time_since_epoch() - unix_start_);
  }
  void sleep_for(Duration duration) override { std::this_thread::sleep_for(duration); }
  void sleep_until_readable(std::span<const int> files, Duration duration) override {
    SWIFTLET_CHECK(files.size() <= kMaxFiles, "a link waits for its socket and its client's");
    duration = std::max(duration, Duration::zero());
    const auto whole = std::chrono::floor<std::chrono::seconds>(duration);
    const timespec longest{.tv_sec = whole.count(),
                           .tv_nsec = (duration - whole) / std::chrono::nanoseconds(1)};
    std::array<pollfd, kMaxFiles> watched{};
    for (std::size_t i = 0; i < files.size(); ++i)
      watched[i] = {.fd = files[i], .events = POLLIN, .revents = 0};
    static_cast<void>(::ppoll(watched.data(), files.size(), &longest, nullptr));
  }

 private:
  MonotonicTime steady_start_ = std::chrono::steady_clock::now();
  Duration unix_start_ = std::chrono::system_clock::now().time_since_epoch();
};

}  // namespace swiftlet

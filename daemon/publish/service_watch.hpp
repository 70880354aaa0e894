// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>

#include "daemon/publish/publisher.hpp"
#include "daemon/system/clock.hpp"
#include "daemon/system/service_manager.hpp"

namespace swiftlet {

/// Reports to the service manager in the publisher's thread, so that a hang of that thread is noticed as
/// well. One thread at a time.
class ServiceWatch {
 public:
  /// How the daemon stands at this tick.
  struct Progress {
    std::uint64_t radio_steps = 0;  ///< counts while samples are taken or a vehicle is polled
    bool input_is_over = false;     ///< the radio thread is done, rightly
    bool is_followed = false;       ///< by another run of the daemon, which does not stop
    std::uint64_t statuses = 0;     ///< published so far
    const DaemonStatus& status;     ///< the newest
  };

  /// `manager` must outlive the watch.
  ServiceWatch(const ServiceManager& manager, MonotonicTime now) : manager_(manager), fed_at_(now) {}

  /// All threads run. By any thread, once; feeds the watchdog, which another run may have left hungry.
  void begin() const {
    manager_.report_ready();
    manager_.feed_watchdog();
  }
  /// To be called at each tick: feeds the watchdog, three times in its period, while the radio thread's
  /// count moves and after the input is over; reports each new status, and once that the daemon stops.
  void look(MonotonicTime now, const Progress& progress);

 private:
  const ServiceManager& manager_;
  MonotonicTime fed_at_;
  std::uint64_t steps_when_fed_ = 0;
  std::uint64_t statuses_told_ = 0;
  bool has_told_stopping_ = false;

  void feed(MonotonicTime now, const Progress& progress);
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>

#include "core/base/time.hpp"

namespace swiftlet {

/// Reports to systemd where it started the daemon as a service of Type=notify (NOTIFY_SOCKET, WATCHDOG_USEC);
/// elsewhere nothing happens. Any thread; allocates, and may wait for the service manager.
class ServiceManager {
 public:
  /// Looks at the environment.
  ServiceManager();

  /// How often it wants to be fed at least; nullopt: not at all.
  [[nodiscard]] std::optional<Duration> watchdog_period() const { return watchdog_period_; }

  void report_ready() const;
  void report_stopping() const;
  void feed_watchdog() const;
  /// One line for `systemctl status`.
  void report_status(const std::string& line) const;

 private:
  std::optional<Duration> watchdog_period_;
};

}  // namespace swiftlet

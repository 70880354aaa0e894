// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/system/service_manager.hpp"

#include <systemd/sd-daemon.h>

#include <chrono>
#include <cstdint>

namespace swiftlet {
namespace {

/// What is not received is sent again or does not matter.
void notify(const char* what) { static_cast<void>(sd_notify(0, what)); }

}  // namespace

ServiceManager::ServiceManager() {
  std::uint64_t period_us = 0;
  if (sd_watchdog_enabled(0, &period_us) > 0) watchdog_period_ = std::chrono::microseconds(period_us);
}

void ServiceManager::report_ready() const { notify("READY=1"); }
void ServiceManager::report_stopping() const { notify("STOPPING=1"); }
void ServiceManager::feed_watchdog() const { notify("WATCHDOG=1"); }
void ServiceManager::report_status(const std::string& line) const { notify(("STATUS=" + line).c_str()); }

}  // namespace swiftlet

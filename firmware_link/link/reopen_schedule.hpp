// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>

#include "core/base/time.hpp"
#include "firmware_link/link/usb_device.hpp"

namespace swiftlet {

/// When to retry a device that is missing or was lost: a second after the last attempt, or as soon as
/// something was plugged in or out.
class ReopenSchedule {
 public:
  /// How often a link without a device checks.
  static constexpr Duration kCheckPeriod = std::chrono::milliseconds(100);
  static constexpr Duration kRetryPeriod = std::chrono::seconds(1);
  /// After so many failed transfers a device counts as lost.
  static constexpr int kMaxFailuresInARow = 10;

  /// Whether to try now; true counts as an attempt.
  [[nodiscard]] bool is_due(UsbBus& bus, HostTime now) {
    const bool changed = bus.has_changed();
    if (!changed && now < retry_at_) return false;
    retry_at_ = now + kRetryPeriod;
    return true;
  }

 private:
  HostTime retry_at_ = HostTime::min();
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstdint>

namespace swiftlet {

using Duration = std::chrono::nanoseconds;

/// Tag of the Unix time of the machine that receives the vehicle's packets. Has no now(): core has no clock,
/// times come with the samples.
struct HostClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = Duration;
  using time_point = std::chrono::time_point<HostClock>;
  static constexpr bool is_steady = false;
};
using HostTime = HostClock::time_point;

/// Tag of the vehicle's own clock, unwrapped: time since it booted (laser logs: the log's own time).
struct DeviceClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = Duration;
  using time_point = std::chrono::time_point<DeviceClock>;
  static constexpr bool is_steady = true;
};
using DeviceTime = DeviceClock::time_point;

constexpr double to_seconds(Duration d) { return std::chrono::duration<double>(d).count(); }
/// Rounded to the nearest nanosecond.
constexpr Duration from_seconds(double seconds) {
  return Duration(static_cast<std::int64_t>(seconds * 1e9 + (seconds < 0.0 ? -0.5 : 0.5)));
}

}  // namespace swiftlet

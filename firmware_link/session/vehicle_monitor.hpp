// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "firmware_link/session/live_status.hpp"
#include "firmware_link/session/log_session.hpp"
#include "firmware_link/session/vehicle_event.hpp"

namespace swiftlet {

/// More than the drift of an estimate at rest: farther from where it stood, the vehicle was carried.
inline constexpr double kCarriedM = 0.5;

/// Reads the vehicle's health from the log records as they pass, and watches for the yaw trap: while the
/// supervisor reports "not flying" the firmware pulls the yaw estimate towards kalman.initialYaw with a time
/// constant of ten seconds, so a vehicle that is carried turns the map. Also for ranges that freeze: the
/// firmware waits without limit for a sensor that hangs, and meanwhile logs the last values of all sensors.
/// One thread at a time; allocates nothing; `session` must outlive it.
class VehicleMonitor {
 public:
  explicit VehicleMonitor(const LogSession& session) : session_(session) {}

  void on_frame(const LogRecord& record);
  /// The dead reckoning of each sample.
  void on_odometry(const Pose2& T_odom_body);
  [[nodiscard]] const VehicleHealth& health() const { return health_; }
  /// At most one of each kind in a connection; of frozen ranges, whenever they freeze.
  [[nodiscard]] std::optional<VehicleEvent> take_event();
  /// A new connection: every event is due again.
  void restart();

 private:
  static constexpr std::size_t kVariables = 10;
  using Ranges = std::array<int, 4>;
  using Slots = std::array<std::optional<std::uint8_t>, kVariables>;
  void watch_ranges(const Ranges& ranges_mm, DeviceTime at);
  const Slots& slots_of(const LogRecord& record);

  const LogSession& session_;
  std::uint32_t revision_ = 0;
  std::array<std::optional<Slots>, 256> slots_{};
  VehicleHealth health_;
  std::optional<Pose2> T_odom_standing_;  ///< since when it is not flying
  bool yaw_trap_ = false;
  bool yaw_trap_reported_ = false;
  bool battery_reported_ = false;
  Ranges ranges_mm_{};
  std::optional<DeviceTime> ranges_moved_at_;  ///< or the flight began, or none was in reach
  bool ranges_are_frozen_ = false;
  bool frozen_reported_ = false;
};

}  // namespace swiftlet

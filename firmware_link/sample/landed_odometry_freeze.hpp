// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>

#include "core/geometry/pose2.hpp"
#include "firmware_link/sample/sample_assembler.hpp"

namespace swiftlet {

/// Holds the dead reckoning still, to the last bit, while the vehicle stands. After a flight, with its motors
/// off, the firmware pulls the yaw estimate back to kalman.initialYaw with a time constant of ten seconds,
/// and the map would turn under it. Ranges measured on the floor meanwhile do not belong into the map either;
/// where a height is logged, the assembler leaves out all of these. After the next take-off the dead
/// reckoning continues from where the vehicle stood, also if its estimator was reset meanwhile. A vehicle
/// that was carried elsewhere restarts it. One that has not flown yet may be carried on purpose: it stands
/// while it reports that it does not fly and is not higher than kStandingM. Where the vehicle reports neither
/// whether it flies nor its thrust, it has landed when it has not been higher than that for two seconds;
/// where it reports no height either, nothing is frozen. One thread at a time; allocates nothing.
class LandedOdometryFreeze {
 public:
  /// Position and yaw may come in different readings.
  [[nodiscard]] Reading hold(const Reading& reading);

 private:
  enum class State : std::uint8_t { kNotFlown, kFlying, kStanding };
  /// nullopt: this reading does not tell.
  [[nodiscard]] std::optional<bool> flies(const Reading& reading);
  void follow_position(const Point2& position, DeviceTime at);
  void follow_height(double height_m, DeviceTime at);
  void follow(bool is_flying);
  void hold_still();
  [[nodiscard]] bool waits_for_its_flight() const;

  State state_ = State::kNotFlown;
  std::uint32_t boot_ = 0;
  bool reports_flight_ = false;
  bool stands_ = false;
  bool restart_pending_ = false;
  std::optional<DeviceTime> low_since_;     ///< by its heights; nothing if the newest is above kStandingM
  std::optional<Point2> position_vehicle_;  ///< the newest, by the vehicle's own dead reckoning
  DeviceTime position_at_{};
  std::optional<double> yaw_vehicle_rad_;
  Pose2 T_vehicle_body_;            ///< of both
  Pose2 T_odom_vehicle_;            ///< from the vehicle's own dead reckoning to the one that was held
  Point2 position_vehicle_landed_;  ///< where it landed, or stood when its dead reckoning was reset
  Pose2 T_odom_body_;               ///< the newest that was held
};

}  // namespace swiftlet

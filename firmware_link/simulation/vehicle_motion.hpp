// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <chrono>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// The true motion at one instant.
struct FlightState {
  Pose2 T_world_body;
  double vx_body_m_s = 0.0;
  double vy_body_m_s = 0.0;
  double yaw_rate_rad_s = 0.0;
  double ax_body_m_s2 = 0.0;
  double ay_body_m_s2 = 0.0;
  double height_m = 0.0;  ///< above the ground below
  double ground_m = 0.0;  ///< elevation of the ground below, relative to storey 0
};

/// Between two states of a flight.
inline constexpr Duration kFlightStep = std::chrono::milliseconds(10);
inline constexpr double kFlightStepS = to_seconds(kFlightStep);
inline constexpr double kGravity = 9.81;  ///< m/s^2

/// The value nearest to `value` in [-magnitude, magnitude].
inline double limited(double value, double magnitude) { return std::clamp(value, -magnitude, magnitude); }

/// How a vehicle follows its setpoints: velocities with a lag, accelerations within limits.
class VehicleMotion {
 public:
  /// At rest on the ground.
  explicit VehicleMotion(const Pose2& T_world_body) { state_.T_world_body = T_world_body; }

  [[nodiscard]] const FlightState& state() const { return state_; }
  void set_height(double height_m) { state_.height_m = height_m; }
  void set_ground(double ground_m) { state_.ground_m = ground_m; }
  /// One kFlightStep towards that velocity, in the world frame, and that yaw rate.
  void step(double vx_m_s, double vy_m_s, double yaw_rate_rad_s);

 private:
  FlightState state_;
  double vx_m_s_ = 0.0;  // in the world frame
  double vy_m_s_ = 0.0;
};

}  // namespace swiftlet

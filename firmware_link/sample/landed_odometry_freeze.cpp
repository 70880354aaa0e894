// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/landed_odometry_freeze.hpp"

#include <limits>
#include <utility>

#include "firmware_link/session/vehicle_monitor.hpp"

namespace swiftlet {

Reading LandedOdometryFreeze::hold(const Reading& reading) {
  if (!reading.position_odom || !reading.yaw_odom_rad) return reading;
  const Pose2 T_vehicle_body(reading.position_odom->x_m, reading.position_odom->y_m, *reading.yaw_odom_rad);
  follow(reading, T_vehicle_body);
  Reading held = reading;
  const Pose2 T_odom_body = T_odom_vehicle_ * T_vehicle_body;
  held.position_odom = T_odom_body.position();
  held.yaw_odom_rad = T_odom_body.yaw_rad();
  held.odometry_restarted = std::exchange(restart_pending_, false);
  if (state_ == State::kStanding)
    for (float& distance : held.distance_m) distance = std::numeric_limits<float>::quiet_NaN();
  return held;
}

void LandedOdometryFreeze::follow(const Reading& reading, const Pose2& T_vehicle_body) {
  if (reading.boot != boot_) {
    *this = LandedOdometryFreeze();
    boot_ = reading.boot;
  }
  if (!reading.is_flying) return;
  if (*reading.is_flying) {
    state_ = State::kFlying;
  } else if (state_ == State::kFlying) {
    state_ = State::kStanding;
    T_vehicle_landed_ = T_vehicle_body;
    T_odom_landed_ = T_odom_vehicle_ * T_vehicle_body;
  }
  if (state_ != State::kStanding) return;
  if (distance_m(T_vehicle_landed_.position(), T_vehicle_body.position()) > kCarriedM) {
    state_ = State::kNotFlown;
    restart_pending_ = true;
  } else {
    T_odom_vehicle_ = T_odom_landed_ * T_vehicle_body.inverse();
  }
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/landed_odometry_freeze.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "firmware_link/sample/level_range.hpp"
#include "firmware_link/session/vehicle_monitor.hpp"

namespace swiftlet {
namespace {

/// The firmware, too, takes a vehicle to fly until it has seen little thrust for that long (supervisor.c,
/// IS_FLYING_HYSTERESIS_THRESHOLD), and pulls the yaw back only from then on. What crosses a box is low for
/// less.
constexpr Duration kLandsAfter = std::chrono::seconds(2);

bool is_finite(const std::optional<Point2>& position) {
  return position && std::isfinite(position->x_m) && std::isfinite(position->y_m);
}

}  // namespace

Reading LandedOdometryFreeze::hold(const Reading& reading) {
  if (reading.boot != boot_) {
    *this = LandedOdometryFreeze();
    boot_ = reading.boot;
  }
  // Numbers that are not finite pass as they are: the assembler leaves them out.
  const bool has_position = is_finite(reading.position_odom);
  const bool has_yaw = reading.yaw_odom_rad && std::isfinite(*reading.yaw_odom_rad);
  if (has_position) follow_position(*reading.position_odom, reading.at);
  if (has_yaw) yaw_vehicle_rad_ = reading.yaw_odom_rad;
  if (reading.height_m) follow_height(*reading.height_m, reading.at);
  const std::optional<bool> is_flying = flies(reading);
  Reading held = reading;
  if (position_vehicle_ && yaw_vehicle_rad_) {
    T_vehicle_body_ = Pose2(position_vehicle_->x_m, position_vehicle_->y_m, *yaw_vehicle_rad_);
    if (is_flying) follow(*is_flying);
    hold_still();
    if (has_position) held.position_odom = T_odom_body_.position();
    if (has_yaw) held.yaw_odom_rad = T_odom_body_.yaw_rad();
    held.odometry_restarted = std::exchange(restart_pending_, false);
  }
  if (state_ == State::kStanding)
    for (float& distance : held.distance_m) distance = std::numeric_limits<float>::quiet_NaN();
  return held;
}

/// Nobody carries a vehicle as fast as an estimator that is reset.
void LandedOdometryFreeze::follow_position(const Point2& position, DeviceTime at) {
  const bool is_reset =
      position_vehicle_ && !is_motion(*position_vehicle_, position, at - position_at_, ContinuityLimits());
  if (is_reset) position_vehicle_landed_ = position;
  position_vehicle_ = position;
  position_at_ = at;
}

void LandedOdometryFreeze::follow_height(double height_m, DeviceTime at) {
  if (!(height_m <= kStandingM)) {
    low_since_.reset();
  } else if (!low_since_) {
    low_since_ = at;
  }
}

std::optional<bool> LandedOdometryFreeze::flies(const Reading& reading) {
  reports_flight_ = reports_flight_ || reading.is_flying.has_value();
  if (reports_flight_ || !reading.height_m || !std::isfinite(*reading.height_m)) return reading.is_flying;
  if (!low_since_) return true;
  return reading.at - *low_since_ < kLandsAfter ? std::nullopt : std::optional(false);
}

void LandedOdometryFreeze::follow(bool is_flying) {
  if (is_flying) {
    state_ = State::kFlying;
  } else if (state_ == State::kFlying) {
    state_ = State::kStanding;
    position_vehicle_landed_ = T_vehicle_body_.position();
  }
}

/// To the last bit: OdometryCalibration corrects all that moves.
void LandedOdometryFreeze::hold_still() {
  if (state_ == State::kStanding &&
      distance_m(position_vehicle_landed_, T_vehicle_body_.position()) > kCarriedM) {
    state_ = State::kNotFlown;
    restart_pending_ = true;
  }
  const bool stood = std::exchange(stands_, state_ == State::kStanding || waits_for_its_flight());
  if (stood && stands_) {
    T_odom_vehicle_ = T_odom_body_ * T_vehicle_body_.inverse();
  } else {
    T_odom_body_ = T_odom_vehicle_ * T_vehicle_body_;
  }
}

bool LandedOdometryFreeze::waits_for_its_flight() const {
  return state_ == State::kNotFlown && reports_flight_ && low_since_.has_value();
}

}  // namespace swiftlet

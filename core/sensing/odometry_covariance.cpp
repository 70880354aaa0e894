// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/odometry_covariance.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

// What a pilot who maps a room may do while nobody hears the vehicle.
constexpr double kDetourSpeedMPerS = 0.5;
constexpr double kDetourTurnRateRadPerS = 0.5;

}  // namespace

UncertainMotion uncertain_step(const OdometryNoise& noise, const Pose2& T_previous_this) {
  const double distance_m = std::hypot(T_previous_this.x_m(), T_previous_this.y_m());
  const double turn_rad = std::abs(T_previous_this.yaw_rad());
  UncertainMotion step{T_previous_this, Eigen::Matrix3d::Zero()};
  if (distance_m == 0.0 && turn_rad == 0.0) return step;
  const double sigma_xy =
      noise.xy_floor_m + noise.xy_per_metre * distance_m + noise.xy_per_radian_m * turn_rad;
  const double sigma_yaw =
      noise.yaw_floor_rad + noise.yaw_per_radian * turn_rad + noise.yaw_per_metre_rad * distance_m;
  step.covariance.diagonal() << sigma_xy * sigma_xy, sigma_xy * sigma_xy, sigma_yaw * sigma_yaw;
  return step;
}

UncertainMotion unwatched_step(const OdometryNoise& noise, const Pose2& T_previous_this, Duration silence) {
  const double distance_m = kDetourSpeedMPerS * to_seconds(silence);
  const double turn_rad = kDetourTurnRateRadPerS * to_seconds(silence);
  UncertainMotion step = uncertain_step(noise, T_previous_this);
  step.covariance += uncertain_step(noise, Pose2(distance_m, 0.0, std::min(turn_rad, kPi))).covariance;
  return step;
}

UncertainMotion operator*(const UncertainMotion& T_a_b, const UncertainMotion& T_b_c) {
  const Eigen::Matrix3d J_first = jacobian_compose_first(T_a_b.T_from_to, T_b_c.T_from_to);
  const Eigen::Matrix3d J_second = jacobian_compose_second(T_a_b.T_from_to);
  return {T_a_b.T_from_to * T_b_c.T_from_to, J_first * T_a_b.covariance * J_first.transpose() +
                                                 J_second * T_b_c.covariance * J_second.transpose()};
}

}  // namespace swiftlet

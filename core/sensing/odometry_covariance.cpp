// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/odometry_covariance.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {

OdometrySigma odometry_sigma(const OdometryNoise& noise, const Pose2& motion, Duration duration) {
  const double distance_m = std::hypot(motion.x_m(), motion.y_m());
  const double turn_rad = std::abs(motion.yaw_rad());
  const double seconds = std::max(to_seconds(duration), 0.001);
  return {std::sqrt(noise.xy_m.variance(distance_m, turn_rad, seconds)),
          std::sqrt(noise.yaw_rad.variance(distance_m, turn_rad, seconds))};
}

UncertainMotion uncertain_step(const OdometryNoise& noise, const Pose2& T_previous_this, Duration duration) {
  const bool stood =
      T_previous_this.x_m() == 0.0 && T_previous_this.y_m() == 0.0 && T_previous_this.yaw_rad() == 0.0;
  if (stood) return {T_previous_this, Eigen::Matrix3d::Zero()};
  return {T_previous_this, odometry_sigma(noise, T_previous_this, duration).covariance()};
}

UncertainMotion unwatched_step(const OdometryNoise& noise, const Pose2& T_previous_this, Duration silence) {
  const Pose2 in_a_second(noise.detour_speed_m_per_s, 0.0, noise.detour_turn_rate_rad_per_s);
  const OdometrySigma sigma = odometry_sigma(noise, in_a_second, std::chrono::seconds(1));
  const double seconds = to_seconds(silence);
  const double yaw_rad2 = seconds * sigma.yaw_rad * sigma.yaw_rad;
  // The detour strays by its own root of time, and the yaw turns that, half of it on average.
  const double strayed_m2 = 0.25 * seconds * noise.detour_speed_m_per_s * noise.detour_speed_m_per_s;
  const double xy_m2 = seconds * sigma.xy_m * sigma.xy_m + yaw_rad2 * strayed_m2;
  UncertainMotion step = uncertain_step(noise, T_previous_this, Duration::zero());
  step.covariance += Eigen::Vector3d(xy_m2, xy_m2, yaw_rad2).asDiagonal();
  return step;
}

UncertainMotion operator*(const UncertainMotion& T_a_b, const UncertainMotion& T_b_c) {
  const Eigen::Matrix3d J_first = jacobian_compose_first(T_a_b.T_from_to, T_b_c.T_from_to);
  const Eigen::Matrix3d J_second = jacobian_compose_second(T_a_b.T_from_to);
  return {T_a_b.T_from_to * T_b_c.T_from_to, J_first * T_a_b.covariance * J_first.transpose() +
                                                 J_second * T_b_c.covariance * J_second.transpose()};
}

}  // namespace swiftlet

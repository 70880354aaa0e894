// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/point_to_line_factor.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/geman_mcclure.hpp"
#include "core/sensing/odometry_covariance.hpp"

namespace swiftlet {

double distance_m(const LocalWall& wall, const Point2& p_map) {
  return (p_map.x_m - wall.center_map.x_m) * wall.normal_map.x_m +
         (p_map.y_m - wall.center_map.y_m) * wall.normal_map.y_m;
}

double judged_distance_m(const std::optional<LocalWall>& wall, const Point2& p_map,
                         const RefinementTuning& tuning) {
  const double cap_m = tuning.cap_sigmas * tuning.wall_sigma_m;
  return wall ? std::min(cap_m, std::abs(distance_m(*wall, p_map))) : cap_m;
}

PointToLineFactor point_to_line_factor(const LocalWall& wall, const Pose2& T_map_body, const Point2& p_body,
                                       const RefinementTuning& tuning) {
  const double off_m = distance_m(wall, T_map_body * p_body);
  const double along_x = -T_map_body.sin_yaw() * p_body.x_m - T_map_body.cos_yaw() * p_body.y_m;
  const double along_y = T_map_body.cos_yaw() * p_body.x_m - T_map_body.sin_yaw() * p_body.y_m;
  const Eigen::Vector3d J(wall.normal_map.x_m, wall.normal_map.y_m,
                          wall.normal_map.x_m * along_x + wall.normal_map.y_m * along_y);
  const double robust =
      1.0 / geman_mcclure_divisor(off_m / (tuning.walls.robust_sigmas * tuning.wall_sigma_m));
  const double weight = robust / (tuning.wall_sigma_m * tuning.wall_sigma_m);
  return {weight * J * J.transpose(), -weight * off_m * J};
}

Pose2 reported_motion(const StoredScan& from, const StoredScan& to, const OdometryCalibration& calibration) {
  if (to.starts_segment && !to.odometry_ran_on) return {};
  return calibration.corrected(between(from.T_odom_body, to.T_odom_body), to.measured_at - from.measured_at);
}

Eigen::Matrix3d motion_information(const StoredScan& from, const StoredScan& to, const OdometryNoise& noise) {
  OdometrySigma sigma = kUnknownMotion;
  const Pose2 T_from_to = between(from.T_dead_body, to.T_dead_body);
  if (to.starts_segment && to.odometry_ran_on) {
    const UncertainMotion guess = unwatched_step(noise, T_from_to, to.measured_at - from.measured_at);
    sigma = {std::sqrt(guess.covariance(0, 0)), std::sqrt(guess.covariance(2, 2))};
  } else if (!to.starts_segment) {
    sigma = odometry_sigma(noise, T_from_to, to.measured_at - from.measured_at);
  }
  return sigma.information().asDiagonal();
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/odometry_drift.hpp"

#include "core/geometry/squared.hpp"

namespace swiftlet {

OdometryDrift::OdometryDrift(const OdometryNoise& noise, const OdometryDriftTuning& tuning)
    : tuning_(tuning),
      estimate_(noise.expected_drift_yaw_per_metre_rad, noise.expected_drift_yaw_per_radian),
      covariance_(Eigen::Vector2d(squared(noise.drift_yaw_per_metre_rad), squared(noise.drift_yaw_per_radian))
                      .asDiagonal()),
      wander_(squared(tuning.wander_share) * covariance_) {}

void OdometryDrift::update(double forward_m, double turn_rad, double yaw_error_rad,
                           double yaw_variance_rad2) {
  const Eigen::Vector2d motion(forward_m, turn_rad);
  covariance_ += wander_;
  const double innovation_variance =
      motion.dot(covariance_ * motion) + squared(tuning_.wall_sigma_rad) + yaw_variance_rad2;
  const Eigen::Vector2d gain = covariance_ * motion / innovation_variance;
  estimate_ += gain * (yaw_error_rad - estimate_.dot(motion));
  covariance_ -= (gain * motion.transpose() * covariance_).eval();
}

double OdometryDrift::yaw_correction_rad(double forward_m, double turn_rad) const {
  return estimate_(0) * forward_m + estimate_(1) * turn_rad;
}

}  // namespace swiftlet

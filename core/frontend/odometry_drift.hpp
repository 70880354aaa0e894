// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>

#include "core/frontend/frontend_tuning.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// Slow estimate of the systematic yaw errors of dead reckoning: the yaw missed with each metre forward
/// (wheels of two sizes, a flow sensor mounted askew) and the share of each turn missed. The Intel Lab log
/// has three degrees per metre: no noise model of independent steps covers that, and lines over a metre of
/// travel are bent. A Kalman filter of two states; its measurement is the graph's final estimate of each
/// motion. Not in the paper.
/// @note Fixed storage. One thread at a time.
class OdometryDrift {
 public:
  /// `noise` gives the drift's expected values, at which the estimate begins, and its standard deviations;
  /// where those are 0, it stays there.
  explicit OdometryDrift(const OdometryNoise& noise, const OdometryDriftTuning& tuning = {});

  /// A motion measured as `forward_m` and `turn_rad` missed `yaw_error_rad` by the graph's estimate; the
  /// variance of that by noise is `yaw_variance_rad2`.
  void update(double forward_m, double turn_rad, double yaw_error_rad, double yaw_variance_rad2);

  /// To be added to the yaw of a measured motion.
  [[nodiscard]] double yaw_correction_rad(double forward_m, double turn_rad) const;

 private:
  OdometryDriftTuning tuning_;
  Eigen::Vector2d estimate_;  // rad/m, rad/rad
  Eigen::Matrix2d covariance_;
  Eigen::Matrix2d wander_;  // process noise of each motion: drift changes slowly
};

}  // namespace swiftlet

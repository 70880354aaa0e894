// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>

#include "core/frontend/frontend_tuning.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// Slow estimate of the systematic yaw errors of dead reckoning: how far it turns, unnoticed, with every
/// metre forward (wheels of two sizes, a flow sensor mounted askew) and what share of each turn it misses.
/// The Intel Lab log has three degrees per metre: no noise model of independent steps bears that, and lines
/// drawn over a metre of travel come out bent. A Kalman filter of two states, fed with the graph's final
/// estimate of each motion. Not in the paper.
/// @note Fixed storage. One thread at a time.
class OdometryDrift {
 public:
  /// `noise` says how large the drift may be; where it says 0, none is ever found.
  explicit OdometryDrift(const OdometryNoise& noise, const OdometryDriftTuning& tuning = {});

  /// The graph says that in a motion of `forward_m` and `turn_rad`, both as measured, the measured yaw lacked
  /// `yaw_error_rad`, of which noise may have `yaw_variance_rad2`.
  void learn(double forward_m, double turn_rad, double yaw_error_rad, double yaw_variance_rad2);

  /// To be added to the yaw of a measured motion.
  [[nodiscard]] double yaw_correction_rad(double forward_m, double turn_rad) const;

 private:
  OdometryDriftTuning tuning_;
  Eigen::Vector2d estimate_ = Eigen::Vector2d::Zero();  // rad/m, rad/rad
  Eigen::Matrix2d covariance_;
  Eigen::Matrix2d wander_;  // what each motion adds: drift changes slowly
};

}  // namespace swiftlet

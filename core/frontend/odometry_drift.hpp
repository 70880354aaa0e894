// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/geometry/angle.hpp"

namespace swiftlet {

/// Slow estimate of a systematic error of dead reckoning: how far it turns, unnoticed, with every metre
/// forward (wheels of two sizes, a flow sensor mounted askew). The Intel Lab log has 2.5 degrees per metre:
/// no noise model of independent steps bears that, and lines drawn over a metre of travel come out bent. A
/// scalar Kalman filter, fed with the graph's final estimate of each motion. Not in the paper.
/// @note Fixed storage. One thread at a time.
class OdometryDrift {
 public:
  /// Estimates of smaller size than `min_rad_per_metre` are not used. Precondition: above 0.
  explicit OdometryDrift(double min_rad_per_metre) : min_rad_per_metre_(min_rad_per_metre) {}

  /// The graph says that over `forward_m` of travel the dead reckoning lacked `yaw_error_rad`, of which noise
  /// may have `yaw_variance_rad2`.
  void learn(double forward_m, double yaw_error_rad, double yaw_variance_rad2);

  /// To be added to the measured yaw, per metre forward; 0 while none is certain.
  [[nodiscard]] double yaw_per_metre_rad() const;

 private:
  double min_rad_per_metre_;
  double estimate_ = 0.0;  // rad/m
  double variance_ = radians(2.0) * radians(2.0);
};

}  // namespace swiftlet

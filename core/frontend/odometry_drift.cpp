// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/odometry_drift.hpp"

#include <cmath>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

constexpr double kWanderPerMotion = radians(0.02);  // rad/m: drift changes slowly
// Walls that err together for a whole window make the graph's estimates err together.
constexpr double kWallSigmaRadians = radians(1.0);

constexpr double squared(double x) { return x * x; }

}  // namespace

void OdometryDrift::learn(double forward_m, double yaw_error_rad, double yaw_variance_rad2) {
  variance_ += squared(kWanderPerMotion);
  const double innovation_variance =
      squared(forward_m) * variance_ + squared(kWallSigmaRadians) + yaw_variance_rad2;
  const double gain = forward_m * variance_ / innovation_variance;
  estimate_ += gain * (yaw_error_rad - forward_m * estimate_);
  variance_ *= 1.0 - gain * forward_m;
}

double OdometryDrift::yaw_per_metre_rad() const {
  return std::abs(estimate_) > min_rad_per_metre_ ? estimate_ : 0.0;
}

}  // namespace swiftlet

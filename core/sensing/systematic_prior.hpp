// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>

#include "core/sensing/systematic_motion.hpp"

namespace swiftlet {

using SystematicCovariance = Eigen::Matrix<double, kSystematicErrors, kSystematicErrors>;

/// Standard deviations of the systematic errors of an input of which nothing else is known.
struct SystematicPrior {
  double range_age_s = 0.1;        ///< about a scan period
  double scale = 0.03;             ///< of odometry
  double scales_apart = 0.01;      ///< forward and sideways: one flow sensor measures both, at one height
  double yaw_per_metre_rad = 0.0;  ///< the yaw: of a gyro
  double yaw_per_radian = 0.01;
  double yaw_per_second_rad = 0.002;
};

/// Of an input with this odometry.
[[nodiscard]] SystematicPrior systematic_prior(const OdometryNoise& noise);

/// Zero where an error is none: wheels do not move sideways.
[[nodiscard]] SystematicCovariance covariance_of(const SystematicPrior& prior, bool has_wheels);

/// The inverse; an error that is none is held.
[[nodiscard]] SystematicCovariance information_of(const SystematicCovariance& prior);

}  // namespace swiftlet

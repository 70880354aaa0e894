// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/systematic_prior.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace swiftlet {

JointEstimate weighed(JointEstimate measured, const SensorModel& sensor, const SystematicPrior& prior,
                      double sigma_factor) {
  const SystematicCovariance before = covariance_of(prior, yaw_goes_with_travel(sensor.odometry));
  SystematicCovariance both = before;
  both.diagonal() += (sigma_factor * measured.sigma).cwiseAbs2();
  for (Eigen::Index k = 0; k < both.rows(); ++k)
    if (before(k, k) == 0.0) both(k, k) = 1.0;
  const SystematicCovariance gain = before * both.inverse();
  measured.errors = gain * measured.errors;
  measured.sigma = (before - gain * before).diagonal().cwiseMax(0.0).cwiseSqrt();
  return measured;
}

InputCalibration calibrated_by(const JointEstimate& estimate, const SensorModel& expected) {
  const auto error = [&](SystematicError which) { return estimate.errors(index_of(which)); };
  InputCalibration calibration{expected, expected, estimate.sigma};
  calibration.found.range_age = std::clamp(
      expected.range_age + from_seconds(error(SystematicError::kRangeAge)), Duration::zero(), kMaxRangeAge);
  calibration.found.odometry_calibration = {
      1.0 + error(SystematicError::kForwardScale), 1.0 + error(SystematicError::kSidewaysScale),
      error(SystematicError::kYawPerMetre), error(SystematicError::kYawPerRadian),
      error(SystematicError::kYawPerSecond)};
  return calibration;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/systematic_prior.hpp"

#include <Eigen/LU>

namespace swiftlet {

JointEstimate weighed(JointEstimate measured, const SensorModel& sensor, const SystematicPrior& prior,
                      double sigma_factor) {
  const SystematicCovariance before = covariance_of(prior, yaw_goes_with_travel(sensor.odometry));
  SystematicCovariance both = before;
  both.diagonal() += (sigma_factor * measured.sigma).cwiseAbs2();
  if (yaw_goes_with_travel(sensor.odometry)) {
    measured.errors(index_of(SystematicError::kYawPerMetre)) -= sensor.odometry_calibration.yaw_per_metre_rad;
    measured.errors(index_of(SystematicError::kYawPerRadian)) -= sensor.odometry_calibration.yaw_per_radian;
  }
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
  calibration.found.range_age =
      within_limits_of_range_age(expected.range_age + from_seconds(error(SystematicError::kRangeAge)));
  OdometryCalibration& odometry = calibration.found.odometry_calibration;
  odometry.forward_scale = 1.0 + error(SystematicError::kForwardScale);
  odometry.sideways_scale = 1.0 + error(SystematicError::kSidewaysScale);
  if (yaw_goes_with_travel(expected.odometry)) {
    OdometryNoise& noise = calibration.found.odometry;
    noise.expected_drift_yaw_per_metre_rad = error(SystematicError::kYawPerMetre);
    noise.expected_drift_yaw_per_radian = error(SystematicError::kYawPerRadian);
    calibration.found.reported_forward_scale = expected.odometry_calibration.forward_scale;
  } else {
    odometry.yaw_per_radian = error(SystematicError::kYawPerRadian);
    odometry.yaw_per_second_rad = error(SystematicError::kYawPerSecond);
  }
  return calibration;
}

}  // namespace swiftlet

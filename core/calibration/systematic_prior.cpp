// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/systematic_prior.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace swiftlet {
namespace {

using Small = Eigen::Matrix<double, kSystematicErrors, kSystematicErrors>;

Small covariance_of(const SystematicPrior& prior, bool has_wheels) {
  Small covariance = Small::Zero();
  const auto set = [&](SystematicError a, SystematicError b, double value) {
    covariance(index_of(a), index_of(b)) = covariance(index_of(b), index_of(a)) = value;
  };
  const auto variance = [&](SystematicError error, double sigma) { set(error, error, sigma * sigma); };
  variance(SystematicError::kRangeAge, prior.range_age_s);
  variance(SystematicError::kForwardScale, prior.scale);
  if (has_wheels) return covariance;  // they do not move sideways, and the frontend learns their yaw
  variance(SystematicError::kForwardScale, std::hypot(prior.scale, prior.scales_apart));
  variance(SystematicError::kSidewaysScale, std::hypot(prior.scale, prior.scales_apart));
  set(SystematicError::kForwardScale, SystematicError::kSidewaysScale, prior.scale * prior.scale);
  variance(SystematicError::kYawPerRadian, prior.yaw_per_radian);
  variance(SystematicError::kYawPerSecond, prior.yaw_per_second_rad);
  return covariance;
}

}  // namespace

JointEstimate weighed(JointEstimate measured, const SensorModel& sensor, const SystematicPrior& prior) {
  const Small before = covariance_of(prior, yaw_goes_with_travel(sensor.odometry));
  Small both = before;
  both.diagonal() += (prior.sigma_factor * measured.sigma).cwiseAbs2();
  for (Eigen::Index k = 0; k < both.rows(); ++k)
    if (before(k, k) == 0.0) both(k, k) = 1.0;
  const Small gain = before * both.inverse();
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

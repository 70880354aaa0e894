// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/systematic_prior.hpp"

#include <Eigen/LU>
#include <cmath>

namespace swiftlet {

SystematicPrior systematic_prior(const OdometryNoise& noise) {
  SystematicPrior prior;
  if (!yaw_goes_with_travel(noise)) return prior;
  prior.yaw_per_metre_rad = noise.drift_yaw_per_metre_rad;
  prior.yaw_per_radian = noise.drift_yaw_per_radian;
  prior.yaw_per_second_rad = 0.0;
  return prior;
}

SystematicCovariance covariance_of(const SystematicPrior& prior, bool has_wheels) {
  SystematicCovariance covariance = SystematicCovariance::Zero();
  const auto set = [&](SystematicError a, SystematicError b, double value) {
    covariance(index_of(a), index_of(b)) = covariance(index_of(b), index_of(a)) = value;
  };
  const auto variance = [&](SystematicError error, double sigma) { set(error, error, sigma * sigma); };
  variance(SystematicError::kRangeAge, prior.range_age_s);
  variance(SystematicError::kForwardScale, prior.scale);
  variance(SystematicError::kYawPerMetre, prior.yaw_per_metre_rad);
  variance(SystematicError::kYawPerRadian, prior.yaw_per_radian);
  variance(SystematicError::kYawPerSecond, prior.yaw_per_second_rad);
  if (has_wheels) return covariance;
  variance(SystematicError::kForwardScale, std::hypot(prior.scale, prior.scales_apart));
  variance(SystematicError::kSidewaysScale, std::hypot(prior.scale, prior.scales_apart));
  set(SystematicError::kForwardScale, SystematicError::kSidewaysScale, prior.scale * prior.scale);
  return covariance;
}

SystematicCovariance information_of(const SystematicCovariance& prior) {
  constexpr double kNoVariance = 1e-18;
  return (prior + kNoVariance * SystematicCovariance::Identity()).inverse();
}

}  // namespace swiftlet

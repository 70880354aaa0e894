// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/systematic_prior.hpp"

#include <cmath>

namespace swiftlet {

SystematicCovariance covariance_of(const SystematicPrior& prior, bool has_wheels) {
  SystematicCovariance covariance = SystematicCovariance::Zero();
  const auto set = [&](SystematicError a, SystematicError b, double value) {
    covariance(index_of(a), index_of(b)) = covariance(index_of(b), index_of(a)) = value;
  };
  const auto variance = [&](SystematicError error, double sigma) { set(error, error, sigma * sigma); };
  variance(SystematicError::kRangeAge, prior.range_age_s);
  variance(SystematicError::kForwardScale, prior.scale);
  if (has_wheels) return covariance;
  variance(SystematicError::kForwardScale, std::hypot(prior.scale, prior.scales_apart));
  variance(SystematicError::kSidewaysScale, std::hypot(prior.scale, prior.scales_apart));
  set(SystematicError::kForwardScale, SystematicError::kSidewaysScale, prior.scale * prior.scale);
  variance(SystematicError::kYawPerRadian, prior.yaw_per_radian);
  variance(SystematicError::kYawPerSecond, prior.yaw_per_second_rad);
  return covariance;
}

}  // namespace swiftlet

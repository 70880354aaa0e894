// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/building_axis.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"
#include "core/geometry/geman_mcclure.hpp"
#include "core/geometry/squared.hpp"

namespace swiftlet {

double BuildingAxis::gate_rad(double variance_rad2) const {
  return std::min(tuning_.max_gate_rad,
                  tuning_.gate_sigmas * std::sqrt(variance_rad2 + variance_rad2_ + heading_variance_rad2_));
}

std::optional<BuildingAxis::Direction> BuildingAxis::direction_near(double yaw_rad,
                                                                    double variance_rad2) const {
  if (!yaw_rad_) return std::nullopt;
  const double off_rad = wrap_axis(yaw_rad - *yaw_rad_);
  const double gate = gate_rad(variance_rad2);
  if (std::abs(off_rad) > gate) return std::nullopt;
  const double ratio = off_rad * tuning_.gate_sigmas / (tuning_.robust_sigmas * gate);
  const double robust = 1.0 / geman_mcclure_divisor(ratio);
  return Direction{yaw_rad - off_rad, robust / squared(tuning_.walls.floor_sigma_rad)};
}

void BuildingAxis::update(std::span<const WallDirection> walls) {
  const std::optional<WallAxis> seen = wall_axis(walls, tuning_.walls);
  if (!seen) return;
  const double seen_variance_rad2 = squared(seen->sigma_rad);
  const double off_rad = yaw_rad_ ? wrap_axis(seen->yaw_rad - *yaw_rad_) : 0.0;
  if (yaw_rad_ && std::abs(off_rad) > gate_rad(seen_variance_rad2)) {
    if (++other_axis_ < tuning_.other_axis_keyframes) return;
    yaw_rad_.reset();
  }
  other_axis_ = 0;
  if (!yaw_rad_) {
    yaw_rad_ = seen->yaw_rad;
    variance_rad2_ = seen_variance_rad2;
    heading_variance_rad2_ = 0.0;
    return;
  }
  const double gain = variance_rad2_ / (variance_rad2_ + heading_variance_rad2_ +
                                        tuning_.keyframes_in_window * seen_variance_rad2);
  *yaw_rad_ += gain * off_rad;
  variance_rad2_ = std::max(squared(tuning_.min_sigma_rad), (1.0 - gain) * variance_rad2_);
  heading_variance_rad2_ *= seen_variance_rad2 / (seen_variance_rad2 + heading_variance_rad2_);
}

}  // namespace swiftlet

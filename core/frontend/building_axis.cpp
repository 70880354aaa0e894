// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/building_axis.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

constexpr double squared(double x) { return x * x; }

constexpr double kSigmas = 3.0;
constexpr double kMaxRad = radians(20);         // nearer to the middle between two axes nothing can be told
constexpr double kWallSigmaRad = radians(2.5);  // of a wall that does run along the axis
constexpr double kRobustSigmas = 2.0;           // Geman-McClure: walls farther off lose their say
constexpr double kSameWallsAgain = 10.0;        // a wall stays in the window for about so many keyframes
constexpr double kMinSigmaRad = radians(0.3);
constexpr int kOtherAxisKeyframes = 24;

}  // namespace

double BuildingAxis::gate_rad(double variance_rad2) const {
  return std::min(kMaxRad, kSigmas * std::sqrt(variance_rad2 + variance_rad2_ + heading_variance_rad2_));
}

std::optional<BuildingAxis::Direction> BuildingAxis::direction_near(double yaw_rad,
                                                                    double variance_rad2) const {
  if (!yaw_rad_) return std::nullopt;
  const double off_rad = wrap_axis(yaw_rad - *yaw_rad_);
  const double gate = gate_rad(variance_rad2);
  if (std::abs(off_rad) > gate) return std::nullopt;
  const double ratio = off_rad * kSigmas / (kRobustSigmas * gate);
  const double robust = 1.0 / squared(1.0 + ratio * ratio);
  return Direction{yaw_rad - off_rad, robust / squared(kWallSigmaRad)};
}

void BuildingAxis::learn(std::span<const WallRun> walls) {
  const std::optional<WallAxis> seen = wall_axis(walls);
  if (!seen) return;
  const double seen_variance_rad2 = squared(seen->sigma_rad);
  const double off_rad = yaw_rad_ ? wrap_axis(seen->yaw_rad - *yaw_rad_) : 0.0;
  if (yaw_rad_ && std::abs(off_rad) > gate_rad(seen_variance_rad2)) {
    if (++other_axis_ < kOtherAxisKeyframes) return;
    yaw_rad_.reset();
  }
  other_axis_ = 0;
  if (!yaw_rad_) {
    yaw_rad_ = seen->yaw_rad;
    variance_rad2_ = seen_variance_rad2;
    heading_variance_rad2_ = 0.0;
    return;
  }
  const double gain =
      variance_rad2_ / (variance_rad2_ + heading_variance_rad2_ + kSameWallsAgain * seen_variance_rad2);
  *yaw_rad_ += gain * off_rad;
  variance_rad2_ = std::max(squared(kMinSigmaRad), (1.0 - gain) * variance_rad2_);
  heading_variance_rad2_ *= seen_variance_rad2 / (seen_variance_rad2 + heading_variance_rad2_);
}

}  // namespace swiftlet

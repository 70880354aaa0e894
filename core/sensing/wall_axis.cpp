// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/wall_axis.hpp"

#include <cmath>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

constexpr double kMinLengthM = 4.0;         // of walls along the axis
constexpr double kMinShare = 0.4;           // ... and of the length of all walls
constexpr double kRivalRad = radians(12);   // an axis farther off than this is another one ...
constexpr double kRivalShare = 0.6;         // ... and must have less than this much of the best one's length
constexpr double kScatterRad = radians(4);  // of walls of one axis: poorly seen ones included
constexpr double kFloorSigmaRad = radians(2.5);  // buildings and sensors are not square beyond that
constexpr int kRounds = 5;

/// What the walls say of an axis near `yaw_rad`, those farther off counting less (Geman-McClure).
struct Support {
  double length_m = 0.0;
  double length2_m2 = 0.0;
  double mean_off_rad = 0.0;
  double mean_square_off_rad2 = 0.0;
};

Support support_of(std::span<const WallRun> walls, double yaw_rad) {
  Support support;
  for (const WallRun& wall : walls) {
    const double off_rad = wrap_axis(wall.yaw_rad - yaw_rad);
    const double ratio = off_rad / kScatterRad;
    const double weighted_m = wall.length_m / ((1.0 + ratio * ratio) * (1.0 + ratio * ratio));
    support.length_m += weighted_m;
    support.length2_m2 += weighted_m * weighted_m;
    support.mean_off_rad += weighted_m * off_rad;
    support.mean_square_off_rad2 += weighted_m * off_rad * off_rad;
  }
  if (support.length_m > 0.0) {
    support.mean_off_rad /= support.length_m;
    support.mean_square_off_rad2 /= support.length_m;
  }
  return support;
}

}  // namespace

double wrap_axis(double yaw_rad) {
  const double turned = std::remainder(yaw_rad, kPi / 2.0);
  return turned >= kPi / 4.0 ? turned - kPi / 2.0 : turned;
}

std::optional<WallAxis> wall_axis(std::span<const WallRun> walls) {
  double all_m = 0.0;
  double yaw_rad = 0.0;
  double best_m = 0.0;
  for (const WallRun& wall : walls) {
    all_m += wall.length_m;
    const double supported_m = support_of(walls, wall.yaw_rad).length_m;
    if (supported_m <= best_m) continue;
    best_m = supported_m;
    yaw_rad = wall.yaw_rad;
  }
  if (best_m < kMinLengthM || best_m < kMinShare * all_m) return std::nullopt;
  Support support;
  for (int round = 0; round < kRounds; ++round) {
    support = support_of(walls, yaw_rad);
    yaw_rad += support.mean_off_rad;
  }
  for (const WallRun& wall : walls) {
    if (std::abs(wrap_axis(wall.yaw_rad - yaw_rad)) < kRivalRad) continue;
    if (support_of(walls, wall.yaw_rad).length_m > kRivalShare * support.length_m) return std::nullopt;
  }
  const double effective_count = support.length_m * support.length_m / support.length2_m2;
  return WallAxis{wrap_axis(yaw_rad), std::sqrt(kFloorSigmaRad * kFloorSigmaRad +
                                                support.mean_square_off_rad2 / effective_count)};
}

}  // namespace swiftlet

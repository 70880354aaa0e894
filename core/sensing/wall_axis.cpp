// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/wall_axis.hpp"

#include <cmath>

#include "core/geometry/angle.hpp"
#include "core/geometry/geman_mcclure.hpp"

namespace swiftlet {
namespace {

/// The walls' support of an axis near `yaw_rad`; those farther off count less (Geman & McClure).
struct Support {
  double length_m = 0.0;
  double length2_m2 = 0.0;
  double mean_off_rad = 0.0;
  double mean_square_off_rad2 = 0.0;
};

Support support_of(std::span<const WallDirection> walls, double yaw_rad, double scatter_rad) {
  Support support;
  for (const WallDirection& wall : walls) {
    const double off_rad = wrap_axis(wall.yaw_rad - yaw_rad);
    const double weighted_m = wall.length_m / geman_mcclure_divisor(off_rad / scatter_rad);
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

/// Of walls farther off an axis, at most one hundredth counts for it: they have another.
double same_axis_rad(const WallAxisTuning& tuning) { return 3.0 * tuning.scatter_rad; }

}  // namespace

double wrap_axis(double yaw_rad) {
  const double turned = std::remainder(yaw_rad, kPi / 2.0);
  return turned >= kPi / 4.0 ? turned - kPi / 2.0 : turned;
}

std::optional<WallAxis> wall_axis(std::span<const WallDirection> walls, const WallAxisTuning& tuning) {
  double all_m = 0.0;
  double yaw_rad = 0.0;
  double best_m = 0.0;
  for (const WallDirection& wall : walls) {
    all_m += wall.length_m;
    const double supported_m = support_of(walls, wall.yaw_rad, tuning.scatter_rad).length_m;
    if (supported_m <= best_m) continue;
    best_m = supported_m;
    yaw_rad = wall.yaw_rad;
  }
  if (best_m < tuning.min_length_m || best_m < tuning.min_share * all_m) return std::nullopt;
  Support support;
  for (int round = 0; round < tuning.rounds; ++round) {
    support = support_of(walls, yaw_rad, tuning.scatter_rad);
    yaw_rad += support.mean_off_rad;
  }
  for (const WallDirection& wall : walls) {
    if (std::abs(wrap_axis(wall.yaw_rad - yaw_rad)) < same_axis_rad(tuning)) continue;
    if (support_of(walls, wall.yaw_rad, tuning.scatter_rad).length_m > tuning.rival_share * support.length_m)
      return std::nullopt;
  }
  const double effective_count = support.length_m * support.length_m / support.length2_m2;
  return WallAxis{wrap_axis(yaw_rad), std::sqrt(tuning.floor_sigma_rad * tuning.floor_sigma_rad +
                                                support.mean_square_off_rad2 / effective_count)};
}

}  // namespace swiftlet

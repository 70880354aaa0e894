// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <span>

#include "core/base/tuning.hpp"
#include "core/geometry/angle.hpp"

namespace swiftlet {

/// What the axis is estimated from.
struct WallDirection {
  double yaw_rad = 0.0;  ///< along the wall, either way
  double length_m = 0.0;
};

struct WallAxisTuning {
  double min_length_m = 4.0;        ///< of walls along the axis ...
  double min_share = 0.4;           ///< ... and of the length of all walls
  double rival_share = 0.6;         ///< another axis must have less than this much of the best one's length
  double scatter_rad = radians(4);  ///< of walls of one axis: poorly seen ones included
  double floor_sigma_rad = radians(2.5);  ///< buildings and sensors are not square beyond that
  int rounds = 5;                         ///< of moving the axis to the weighted mean

  static constexpr TuningValue<WallAxisTuning> kValues[] = {
      {"min_length_m", &WallAxisTuning::min_length_m},       {"min_share", &WallAxisTuning::min_share},
      {"rival_share", &WallAxisTuning::rival_share},         {"scatter_rad", &WallAxisTuning::scatter_rad},
      {"floor_sigma_rad", &WallAxisTuning::floor_sigma_rad}, {"rounds", &WallAxisTuning::rounds}};
};

/// The direction that walls run along or at right angles to, in the frame of those walls.
struct WallAxis {
  double yaw_rad = 0.0;  ///< one of four, a quarter turn apart; in [-pi/4, pi/4)
  double sigma_rad = 0.0;
};

/// The same axis in [-pi/4, pi/4): axes repeat after a quarter turn.
double wrap_axis(double yaw_rad);

/// The axis along which most of the walls' length lies (the Manhattan frame of Coughlan & Yuille 1999,
/// "Manhattan World", in the plane). Nothing where the walls are too short together, or where a second axis
/// is nearly as good. Allocates nothing; quadratic in the number of walls.
std::optional<WallAxis> wall_axis(std::span<const WallDirection> walls, const WallAxisTuning& tuning = {});

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <span>

namespace swiftlet {

/// What of a wall tells the axis.
struct WallRun {
  double yaw_rad = 0.0;  ///< along the wall, either way
  double length_m = 0.0;
};

/// The direction that walls run in or stand square to, in the frame of the walls it was seen in.
struct WallAxis {
  double yaw_rad = 0.0;  ///< one of four, a quarter turn apart; in [-pi/4, pi/4)
  double sigma_rad = 0.0;
};

/// The same axis in [-pi/4, pi/4): axes repeat after a quarter turn.
double wrap_axis(double yaw_rad);

/// The axis that most of the walls' length agrees on (the Manhattan frame of Coughlan & Yuille 1999,
/// "Manhattan World", in the plane). Nothing where the walls are too short together, or where a second axis
/// is nearly as good. Allocates nothing; quadratic in the number of walls.
std::optional<WallAxis> wall_axis(std::span<const WallRun> walls);

}  // namespace swiftlet

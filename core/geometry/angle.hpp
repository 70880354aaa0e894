// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cmath>
#include <numbers>

namespace swiftlet {

inline constexpr double kPi = std::numbers::pi;

constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / kPi); }

/// The same direction in [-pi, pi).
inline double wrap_angle(double angle_rad) {
  if (angle_rad >= -kPi && angle_rad < kPi) return angle_rad;
  const double turns = std::floor((angle_rad + kPi) / (2.0 * kPi));
  const double wrapped = angle_rad - turns * (2.0 * kPi);
  return wrapped >= kPi ? -kPi : wrapped;  // rounding can leave it a hair outside
}

}  // namespace swiftlet

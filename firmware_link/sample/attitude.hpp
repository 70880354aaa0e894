// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace swiftlet {

/// Rotation from body to world, unit length.
struct Quaternion {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
};

/// How far the body is from level: the vertical component, up, of the unit vector along each of its
/// horizontal axes.
struct BodyTilt {
  double x_up = 0.0;
  double y_up = 0.0;

  /// False for what no rotation gives: NaN, or a quaternion that is not of unit length.
  [[nodiscard]] bool is_possible() const { return x_up * x_up + y_up * y_up <= 1.0; }
};

/// Heading of the body's x axis, counter-clockwise, -pi..pi (Diebel 2006, "Representing Attitude", eq. 290).
inline double yaw_of(const Quaternion& q) {
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

/// The last row of the rotation matrix (Diebel 2006, eq. 125).
inline BodyTilt tilt_of(const Quaternion& q) {
  return {2.0 * (q.x * q.z - q.w * q.y), 2.0 * (q.y * q.z + q.w * q.x)};
}

/// The same of Euler angles about z, y, x; `pitch_rad` is nose up, as the firmware logs it.
inline BodyTilt tilt_of(double roll_rad, double pitch_rad) {
  return {std::sin(pitch_rad), std::sin(roll_rad) * std::cos(pitch_rad)};
}

/// The firmware's 32-bit form (stateEstimateZ.quat): bits 31..30 select the largest of x, y, z, w, which is
/// positive and left out; the other three follow in order, a sign bit and nine bits of magnitude in units of
/// 1 / (511 sqrt 2).
inline Quaternion unpack_quaternion(std::uint32_t packed) {
  double q[4] = {0.0, 0.0, 0.0, 0.0};
  const std::size_t largest = packed >> 30;
  double sum_of_squares = 0.0;
  unsigned shift = 20;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == largest) continue;
    const std::uint32_t field = (packed >> shift) & 0x3FF;
    const double magnitude = static_cast<double>(field & 0x1FF) / 511.0 / std::sqrt(2.0);
    q[i] = (field & 0x200) != 0 ? -magnitude : magnitude;
    sum_of_squares += magnitude * magnitude;
    shift -= 10;
  }
  q[largest] = std::sqrt(std::fmax(0.0, 1.0 - sum_of_squares));
  return {q[0], q[1], q[2], q[3]};
}

}  // namespace swiftlet

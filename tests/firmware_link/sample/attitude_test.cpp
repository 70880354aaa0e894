// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/attitude.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

/// The firmware's rule, written the other way round.
std::uint32_t pack(const std::array<double, 4>& q) {
  std::size_t largest = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (std::abs(q[i]) > std::abs(q[largest])) largest = i;
  const bool negate = q[largest] < 0.0;
  auto packed = static_cast<std::uint32_t>(largest);
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == largest) continue;
    const bool negative = (q[i] < 0.0) != negate;
    const auto magnitude = static_cast<std::uint32_t>(std::lround(511.0 * std::abs(q[i]) * std::sqrt(2.0)));
    packed = (packed << 10) | (negative ? 0x200U : 0U) | magnitude;
  }
  return packed;
}

TEST(Attitude, YawOfATurnAboutTheVerticalIsTheTurn) {
  for (const double yaw : {-3.0, -1.0, 0.0, 0.5, 3.1}) {
    const Quaternion q{0.0, 0.0, std::sin(yaw / 2.0), std::cos(yaw / 2.0)};
    EXPECT_NEAR(yaw_of(q), yaw, 1e-12);
  }
}

TEST(Attitude, YawIsTheHeadingOfTheBodysXAxisWhenTilted) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    Quaternion q{normal(random), normal(random), normal(random), normal(random)};
    const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    q = {q.x / norm, q.y / norm, q.z / norm, q.w / norm};
    const double axis_x = q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z;
    const double axis_y = 2.0 * (q.x * q.y + q.w * q.z);
    EXPECT_NEAR(wrap_angle(yaw_of(q) - std::atan2(axis_y, axis_x)), 0.0, 1e-9);
  }
}

TEST(Attitude, TiltOfAQuaternionIsThatOfItsEulerAngles) {
  const double roll_rad = 0.2;
  const double pitch_rad = 0.3;  // nose up: about -y
  const double yaw_rad = 1.0;
  const double cr = std::cos(roll_rad / 2.0), sr = std::sin(roll_rad / 2.0);
  const double cp = std::cos(-pitch_rad / 2.0), sp = std::sin(-pitch_rad / 2.0);
  const double cy = std::cos(yaw_rad / 2.0), sy = std::sin(yaw_rad / 2.0);
  const Quaternion q{sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
                     cr * cp * cy + sr * sp * sy};
  EXPECT_NEAR(yaw_of(q), yaw_rad, 1e-12);
  EXPECT_NEAR(tilt_of(q).x_up, std::sin(pitch_rad), 1e-12) << "the nose points up";
  EXPECT_NEAR(tilt_of(q).y_up, std::sin(roll_rad) * std::cos(pitch_rad), 1e-12);
  EXPECT_NEAR(tilt_of(roll_rad, pitch_rad).x_up, tilt_of(q).x_up, 1e-12);
  EXPECT_NEAR(tilt_of(roll_rad, pitch_rad).y_up, tilt_of(q).y_up, 1e-12);
}

TEST(Attitude, PackedQuaternionComesBackToItsResolution) {
  std::mt19937 random(42);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    std::array<double, 4> q{normal(random), normal(random), normal(random), normal(random)};
    double norm = 0.0;
    for (const double v : q) norm += v * v;
    for (double& v : q) v /= std::sqrt(norm);
    const Quaternion back = unpack_quaternion(pack(q));
    const double dot = q[0] * back.x + q[1] * back.y + q[2] * back.z + q[3] * back.w;
    EXPECT_NEAR(std::abs(dot), 1.0, 1e-5);
  }
}

TEST(Attitude, IdentityIsPackedAsItsLargestIndexAlone) {
  const Quaternion q = unpack_quaternion(0xC0000000U);
  EXPECT_DOUBLE_EQ(q.w, 1.0);
  EXPECT_DOUBLE_EQ(yaw_of(q), 0.0);
}

}  // namespace
}  // namespace swiftlet

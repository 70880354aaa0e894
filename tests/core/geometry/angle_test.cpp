// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/geometry/angle.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

TEST(WrapAngle, KeepsAnglesThatAreWithin) {
  for (const double angle : {-kPi, -1.0, 0.0, 3.0}) EXPECT_EQ(wrap_angle(angle), angle);
}

TEST(WrapAngle, TakesTheUpperBoundToTheLower) { EXPECT_EQ(wrap_angle(kPi), -kPi); }

TEST(WrapAngle, KeepsTheDirectionAndTheBounds) {
  test::RandomGeometry random(1);
  for (int i = 0; i < 10'000; ++i) {
    const double angle = random.uniform(-100.0, 100.0);
    const double wrapped = wrap_angle(angle);
    ASSERT_GE(wrapped, -kPi);
    ASSERT_LT(wrapped, kPi);
    ASSERT_NEAR(std::cos(wrapped), std::cos(angle), 1e-12);
    ASSERT_NEAR(std::sin(wrapped), std::sin(angle), 1e-12);
  }
}

TEST(WrapAngle, StaysWithinJustBesideTheBounds) {
  for (const double turns : {-3.0, -1.0, 1.0, 3.0}) {
    for (const double towards : {-1e9, 1e9}) {
      const double wrapped = wrap_angle(std::nextafter(turns * kPi, towards));
      EXPECT_GE(wrapped, -kPi);
      EXPECT_LT(wrapped, kPi);
    }
  }
}

TEST(Degrees, AreTheInverseOfRadians) {
  EXPECT_DOUBLE_EQ(radians(180.0), kPi);
  EXPECT_DOUBLE_EQ(degrees(radians(30.0)), 30.0);
}

}  // namespace
}  // namespace swiftlet

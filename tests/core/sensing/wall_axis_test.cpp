// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/wall_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/geometry/angle.hpp"
#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

/// Walls along and square to an axis, seen with an error.
std::vector<WallDirection> square_walls(test::RandomGeometry& random, double axis_rad, int count,
                                        double sigma_rad) {
  std::vector<WallDirection> walls;
  walls.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    walls.push_back({axis_rad + i * kPi / 2.0 + random.normal(sigma_rad), random.uniform(0.5, 3.0)});
  return walls;
}

TEST(WrapAxis, RepeatsAfterAQuarterTurn) {
  for (const double yaw_rad : {-0.7, -0.2, 0.0, 0.3, 0.78}) {
    for (int quarters = -5; quarters <= 5; ++quarters)
      EXPECT_NEAR(wrap_axis(yaw_rad + quarters * kPi / 2.0), yaw_rad, 1e-12);
  }
  EXPECT_DOUBLE_EQ(wrap_axis(kPi / 4.0), -kPi / 4.0);
  EXPECT_DOUBLE_EQ(wrap_axis(-kPi / 4.0), -kPi / 4.0);
}

TEST(WallAxis, IsFoundInWhicheverDirectionTheBuildingStands) {
  test::RandomGeometry random(1);
  for (int i = 0; i < 100; ++i) {
    const double truth_rad = random.uniform(-kPi, kPi);
    const auto axis = wall_axis(square_walls(random, truth_rad, 12, radians(3)));
    ASSERT_TRUE(axis) << "building " << i;
    EXPECT_NEAR(wrap_axis(axis->yaw_rad - truth_rad), 0.0, radians(4));
    EXPECT_GE(axis->yaw_rad, -kPi / 4.0);
    EXPECT_LT(axis->yaw_rad, kPi / 4.0);
  }
}

TEST(WallAxis, LiesWithinTheUncertaintyItClaims) {
  test::RandomGeometry random(2);
  int found = 0;
  int outside = 0;
  double squares = 0.0;
  for (int i = 0; i < 300; ++i) {
    const auto axis = wall_axis(square_walls(random, 0.3, 10, radians(4)));
    if (!axis) continue;  // they scatter too widely for one
    ++found;
    const double in_sigmas = wrap_axis(axis->yaw_rad - 0.3) / axis->sigma_rad;
    squares += in_sigmas * in_sigmas;
    outside += std::abs(in_sigmas) > 2.0 ? 1 : 0;
  }
  EXPECT_GE(found, 285);
  EXPECT_LE(outside, 15) << "of 300 beyond two standard deviations";
  EXPECT_GT(squares / found, 0.5) << "it claims little more than there is";
  EXPECT_LT(squares / found, 1.1);
}

TEST(WallAxis, IsNotMovedByClutter) {
  test::RandomGeometry random(3);
  std::vector<WallDirection> walls = square_walls(random, 0.2, 10, radians(1));
  for (const double yaw_rad : {0.2 + radians(25), 0.2 + radians(33), 0.2 - radians(28)})
    walls.push_back({yaw_rad, 1.0});
  const auto axis = wall_axis(walls);
  ASSERT_TRUE(axis);
  EXPECT_NEAR(axis->yaw_rad, 0.2, radians(1.5));
}

TEST(WallAxis, IsNoneWhereWallsRunEveryWay) {
  std::vector<WallDirection> walls;
  walls.reserve(18);
  for (int i = 0; i < 18; ++i) walls.push_back({radians(5.0 * i), 2.0});
  EXPECT_FALSE(wall_axis(walls));
}

TEST(WallAxis, IsNoneBetweenTwoAsGood) {
  const std::vector<WallDirection> walls{
      {0.0, 4.0}, {kPi / 2.0, 4.0}, {radians(30), 4.0}, {radians(120), 3.8}};
  EXPECT_FALSE(wall_axis(walls));
}

TEST(WallAxis, IsNoneOfNothingOrOfShortWalls) {
  EXPECT_FALSE(wall_axis({}));
  EXPECT_FALSE(wall_axis(std::vector<WallDirection>{{0.1, 1.0}, {0.1, 1.5}}));
}

}  // namespace
}  // namespace swiftlet

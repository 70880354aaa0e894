// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/building_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

constexpr double kSeen = radians(2) * radians(2);  // variance of a wall's direction
constexpr int kWindow = 24;                        // keyframes

std::vector<WallDirection> walls_along(double yaw_rad) {
  return {{yaw_rad, 4.0}, {yaw_rad + kPi / 2.0, 3.0}, {yaw_rad, 2.0}};
}

BuildingAxis estimated_axis(double yaw_rad) {
  BuildingAxis axis;
  for (int i = 0; i < kWindow; ++i) axis.update(walls_along(yaw_rad));
  return axis;
}

TEST(BuildingAxis, SaysNothingBeforeItHasSeenWalls) {
  EXPECT_FALSE(BuildingAxis().direction_near(0.0, kSeen));
}

TEST(BuildingAxis, TellsTheDirectionOfAWallNearIt) {
  const BuildingAxis axis = estimated_axis(0.1);
  for (const double quarter : {0.0, kPi / 2.0, kPi, -kPi / 2.0}) {
    const auto direction = axis.direction_near(0.1 + quarter + radians(3), kSeen);
    ASSERT_TRUE(direction);
    EXPECT_NEAR(direction->yaw_rad, 0.1 + quarter, radians(0.1))
        << "not wrapped: near the wall as it was seen";
    EXPECT_GT(direction->information, 0.0);
  }
}

TEST(BuildingAxis, LeavesAWallAloneThatRunsAnotherWay) {
  const BuildingAxis axis = estimated_axis(0.1);
  EXPECT_FALSE(axis.direction_near(0.1 + radians(30), kSeen));
  EXPECT_FALSE(axis.direction_near(0.1 - radians(15), kSeen));
}

TEST(BuildingAxis, BelievesAWallLessTheFartherOffItIs) {
  const BuildingAxis axis = estimated_axis(0.0);
  const auto near = axis.direction_near(radians(0.5), kSeen);
  const auto far = axis.direction_near(radians(6), kSeen);
  ASSERT_TRUE(near && far);
  EXPECT_GT(near->information, 2.0 * far->information);
}

TEST(BuildingAxis, LooksFartherAfterACornerThatTheHeadingMayHaveLostItselfIn) {
  BuildingAxis axis = estimated_axis(0.0);
  EXPECT_FALSE(axis.direction_near(radians(14), kSeen));
  axis.turn(radians(5) * radians(5));
  EXPECT_TRUE(axis.direction_near(radians(14), kSeen));
  axis.turn(radians(60) * radians(60));
  EXPECT_FALSE(axis.direction_near(radians(25), kSeen)) << "half way to the other axis it cannot tell";
}

TEST(BuildingAxis, IsNotMovedByAFewWallsOfAnotherAxis) {
  BuildingAxis axis = estimated_axis(0.0);
  for (int i = 0; i < kWindow - 1; ++i) axis.update(walls_along(radians(30)));
  const auto direction = axis.direction_near(radians(1), kSeen);
  ASSERT_TRUE(direction);
  EXPECT_NEAR(direction->yaw_rad, 0.0, radians(0.1));
}

TEST(BuildingAxis, GoesOverToAnotherAxisWhenTheWindowHoldsNoOther) {
  BuildingAxis axis = estimated_axis(0.0);
  for (int i = 0; i < kWindow; ++i) axis.update(walls_along(radians(30)));
  const auto direction = axis.direction_near(radians(31), kSeen);
  ASSERT_TRUE(direction);
  EXPECT_NEAR(direction->yaw_rad, radians(30), radians(0.1));
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/building_plan.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace swiftlet {
namespace {

double length_m(const std::vector<WallSegment>& walls) {
  double sum_m = 0.0;
  for (const WallSegment& wall : walls) sum_m += distance_m(wall.start, wall.end);
  return sum_m;
}

/// Of the directions around a point, those that meet a wall.
int directions_closed(const std::vector<WallSegment>& walls, const Point2& from) {
  int closed = 0;
  for (int degree = 0; degree < 360; ++degree)
    closed += cast_ray(walls, from, radians(degree), 100.0) ? 1 : 0;
  return closed;
}

TEST(BuildingPlan, SurroundsTheUnionOfItsAreas) {
  BuildingPlan plan;
  plan.add_area(rectangle({}, 0.0, 0.0, 4.0, 2.0));
  plan.add_area(rectangle({}, 3.0, 0.5, 6.0, 1.5));
  EXPECT_NEAR(length_m(plan.boundary()), 12.0 - 1.0 + 5.0, 0.02);
  EXPECT_EQ(directions_closed(plan.walls(), {3.5, 1.0}), 360);
}

TEST(BuildingPlan, MitresTheCornersOfACorridor) {
  BuildingPlan plan;
  plan.add_corridor({{0.0, 0.0}, {10.0, 0.0}, {10.0, 8.0}}, 2.0);
  EXPECT_EQ(directions_closed(plan.walls(), {9.8, 0.2}), 360);
  const auto corner = cast_ray(plan.walls(), {10.0, 0.0}, -kPi / 4.0, 5.0);
  ASSERT_TRUE(corner);
  EXPECT_NEAR(corner->distance_m, std::sqrt(2.0), 0.1);
}

TEST(BuildingPlan, ClosesACorridorThatReturns) {
  BuildingPlan plan;
  plan.add_corridor(regular_polygon({}, 8.0, 7), 2.0, true);
  for (const Point2& corner : regular_polygon({}, 8.0, 7))
    EXPECT_EQ(directions_closed(plan.walls(), corner), 360);
}

TEST(BuildingPlan, BuildsRoomsBesideACorridorOnlyWhereTheyAreFree) {
  NoiseSource noise(1, "rooms");
  BuildingPlan plan;
  plan.add_corridor({{0.0, 0.0}, {20.0, 0.0}}, 2.0);
  plan.add_corridor({{0.0, 2.6}, {20.0, 2.6}}, 2.0);  // no room between the two
  plan.add_rooms({0.0, 0.0}, {20.0, 0.0}, 2.0, {.built_share = 1.0, .open_share = 1.0}, noise);
  EXPECT_GT(plan.areas().size(), 6U);
  for (std::size_t i = 2; i < plan.areas().size(); ++i)
    for (const Point2& corner : plan.areas()[i]) EXPECT_LT(corner.y_m, 1.6);
}

TEST(BuildingPlan, LeavesANicheForAShutDoor) {
  NoiseSource noise(1, "rooms");
  BuildingPlan plan;
  plan.add_corridor({{0.0, 0.0}, {20.0, 0.0}}, 2.0);
  plan.add_rooms({0.0, 0.0}, {20.0, 0.0}, 2.0, {.built_share = 1.0, .open_share = 0.0}, noise);
  EXPECT_GT(plan.areas().size(), 4U);
  for (const Outline& area : plan.areas())
    for (const Point2& corner : area) EXPECT_LT(std::abs(corner.y_m), 1.1);
}

TEST(BuildingPlan, HasNoWallsUnderTheSky) {
  BuildingPlan plan;
  plan.open_to_the_sky();
  plan.add_area(rectangle({}, 0.0, 0.0, 9.0, 9.0));
  plan.add_obstacle(rectangle({}, 4.0, 4.0, 5.0, 5.0));
  EXPECT_TRUE(plan.boundary().empty());
  EXPECT_EQ(plan.walls().size(), 4U);
}

TEST(WholeBetween, DrawsBothEndsAndNothingElse) {
  NoiseSource noise(1, "whole");
  std::vector<int> counts(3, 0);
  for (int i = 0; i < 300; ++i) ++counts.at(static_cast<std::size_t>(whole_between(noise, 4, 6) - 4));
  for (const int count : counts) EXPECT_GT(count, 60);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/free_space_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace swiftlet {
namespace {

/// A corridor around a block, 12 m x 8 m between the middles.
BuildingPlan ring() {
  BuildingPlan plan;
  plan.add_corridor({{0.0, 0.0}, {12.0, 0.0}, {12.0, 8.0}, {0.0, 8.0}}, 2.0, true);
  return plan;
}

double length_m(const std::vector<Point2>& line) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum_m += distance_m(line[i - 1], line[i]);
  return sum_m;
}

TEST(FreeSpaceGrid, KeepsOffWallsAndObstacles) {
  BuildingPlan plan = ring();
  plan.add_obstacle(regular_polygon({6.0, 0.0}, 0.1, 8));
  const FreeSpaceGrid grid(plan);
  for (const Point2& place : grid.places())
    for (const WallSegment& wall : plan.walls()) EXPECT_GE(distance_m(wall, place), FreeSpaceGrid::kMarginM);
  EXPECT_EQ(grid.clearance_m({6.0, 4.0}), 0.0) << "inside the block";
}

TEST(FreeSpaceGrid, GoesRoundCornersTheShortWay) {
  FreeSpaceGrid grid(ring());
  const auto line = grid.route({1.0, 0.0}, {0.0, 5.0}, false);
  ASSERT_TRUE(line);
  EXPECT_LT(length_m(*line), 6.6);
  EXPECT_LT(line->size(), 6U);
}

TEST(FreeSpaceGrid, KeepsToTheMiddleOfACorridor) {
  FreeSpaceGrid grid(ring());
  const auto line = grid.route({1.0, 0.5}, {0.0, 7.0}, false);
  ASSERT_TRUE(line);
  EXPECT_TRUE(std::ranges::any_of(*line, [&](const Point2& p) { return grid.clearance_m(p) > 0.8; }));
}

TEST(FreeSpaceGrid, PrefersWaysThatWereNotFlownWhereAsked) {
  FreeSpaceGrid grid(ring());
  grid.mark_flown({1.0, 0.0}, {0.0, 0.0});
  grid.mark_flown({0.0, 0.0}, {0.0, 8.0});
  const auto short_line = grid.route({1.0, 0.0}, {1.0, 8.0}, false);
  const auto new_line = grid.route({1.0, 0.0}, {1.0, 8.0}, true);
  ASSERT_TRUE(short_line && new_line);
  EXPECT_LT(length_m(*short_line), 11.0);
  EXPECT_GT(length_m(*new_line), 25.0);
}

TEST(FreeSpaceGrid, LeavesOutWhatCannotBeReached) {
  BuildingPlan plan = ring();
  plan.add_area(rectangle({}, 20.0, 0.0, 23.0, 3.0));
  FreeSpaceGrid grid(plan);
  EXPECT_EQ(grid.clearance_m({21.5, 1.5}), 0.0);
  EXPECT_FALSE(grid.route({1.0, 0.0}, {21.5, 1.5}, false));
}

TEST(FreeSpaceGrid, DoesNotLeadUnderATable) {
  BuildingPlan plan;
  plan.add_area(rectangle({}, 0.0, 0.0, 6.0, 6.0));
  plan.keep_out(rectangle({}, 2.0, 1.0, 4.0, 5.0));
  FreeSpaceGrid grid(plan);
  const auto line = grid.route({1.0, 3.0}, {5.0, 3.0}, false);
  ASSERT_TRUE(line);
  EXPECT_GT(length_m(*line), 5.0);
}

}  // namespace
}  // namespace swiftlet

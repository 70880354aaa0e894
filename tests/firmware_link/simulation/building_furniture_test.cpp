// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/building_furniture.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "firmware_link/simulation/free_space_grid.hpp"

namespace swiftlet {
namespace {

BuildingPlan room() {
  BuildingPlan plan;
  plan.add_area(rectangle({}, 0.0, 0.0, 12.0, 9.0));
  return plan;
}

TEST(Furnish, PlacesAllSortsWithinTheWalls) {
  NoiseSource noise(1, "furniture");
  BuildingPlan plan = room();
  furnish(plan, {.at_walls = 6, .tables = 2, .chairs = 3, .people = 3, .is_askew = true}, noise);
  EXPECT_GT(plan.obstacles().size(), 8U);
  EXPECT_FALSE(plan.kept_out().empty()) << "below a table";
  const Outline walls = rectangle({}, -1e-6, -1e-6, 12.0 + 1e-6, 9.0 + 1e-6);
  for (const Outline& obstacle : plan.obstacles())
    EXPECT_TRUE(std::ranges::all_of(obstacle, [&](const Point2& corner) { return contains(walls, corner); }));
}

TEST(Furnish, LeavesWaysBetweenThePieces) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    NoiseSource noise(seed, "furniture");
    BuildingPlan plan = room();
    plan.add_corridor({{12.0, 4.0}, {20.0, 4.0}}, 1.6);
    const std::size_t places_when_empty = FreeSpaceGrid(plan).places().size();
    furnish(plan, {.at_walls = 20, .tables = 6, .chairs = 10, .people = 10}, noise);
    const FreeSpaceGrid grid(plan);
    EXPECT_GT(grid.places().size(), places_when_empty / 2) << seed;
    EXPECT_TRUE(std::ranges::any_of(grid.places(), [](const Point2& place) { return place.x_m > 18.0; }))
        << seed;
  }
}

TEST(Furnish, AddsNothingWhereThereIsNoRoom) {
  NoiseSource noise(1, "furniture");
  BuildingPlan plan;
  plan.add_corridor({{0.0, 0.0}, {20.0, 0.0}}, 1.1);
  furnish(plan, {.at_walls = 10, .tables = 5, .chairs = 5, .people = 5}, noise);
  EXPECT_TRUE(plan.obstacles().empty());
}

}  // namespace
}  // namespace swiftlet

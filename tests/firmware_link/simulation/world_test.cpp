// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace swiftlet {
namespace {

TEST(SimulatedWorld, HasTheWallsOfTheStoreyThatTheGroundIsNearestTo) {
  using Walls = std::vector<WallSegment>;
  const SimulatedWorld house{
      .walls = Walls(1), .flight = {}, .upper_walls = {Walls(2), Walls(3)}, .storey_height_m = 3.0};
  const std::pair<double, std::size_t> cases[] = {{-4.0, 1}, {0.0, 1}, {1.4, 1}, {1.6, 2},
                                                  {3.0, 2},  {4.4, 2}, {4.6, 3}, {20.0, 3}};
  for (const auto& [ground_m, walls] : cases) EXPECT_EQ(house.walls_at(ground_m).size(), walls) << ground_m;
}

TEST(CastRay, MeetsAWallSquarely) {
  const WallSegment wall{{2.0, -1.0}, {2.0, 1.0}};
  const auto hit = cast_ray({&wall, 1}, {0.5, 0.0}, 0.0, 10.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance_m, 1.5, 1e-12);
  EXPECT_NEAR(hit->cos_incidence, 1.0, 1e-12);
}

TEST(CastRay, MeetsAnObliqueWallAtItsAngle) {
  // The wall x + y = 2, met from the origin along x: at (2, 0), 45 degrees off its normal.
  const WallSegment wall{{0.0, 2.0}, {4.0, -2.0}};
  const auto hit = cast_ray({&wall, 1}, {0.0, 0.0}, 0.0, 10.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance_m, 2.0, 1e-12);
  EXPECT_NEAR(hit->cos_incidence, std::sqrt(0.5), 1e-12);
}

TEST(CastRay, PassesByTheEndsOfAWall) {
  const WallSegment wall{{2.0, 0.1}, {2.0, 1.0}};
  EXPECT_FALSE(cast_ray({&wall, 1}, {0.0, 0.0}, 0.0, 10.0));
  EXPECT_TRUE(cast_ray({&wall, 1}, {0.0, 0.0}, std::atan2(0.5, 2.0), 10.0));
}

TEST(CastRay, SeesNothingBehindItNorAlongAWallNorTooFarAway) {
  const WallSegment wall{{2.0, -1.0}, {2.0, 1.0}};
  EXPECT_FALSE(cast_ray({&wall, 1}, {0.0, 0.0}, kPi, 10.0));
  EXPECT_FALSE(cast_ray({&wall, 1}, {0.0, 0.0}, kPi / 2.0, 10.0));
  EXPECT_FALSE(cast_ray({&wall, 1}, {0.0, 0.0}, 0.0, 1.9));
}

TEST(CastRay, TakesTheNearestWallInWhateverOrder) {
  const WallSegment walls[] = {
      {{3.0, -1.0}, {3.0, 1.0}}, {{1.0, 1.0}, {1.0, -1.0}}, {{2.0, -1.0}, {2.0, 1.0}}};
  const auto hit = cast_ray(walls, {0.0, 0.0}, 0.0, 10.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance_m, 1.0, 1e-12);
}

TEST(CastRay, SeesGlassOnlyWhenItMeetsItSquarely) {
  const WallSegment walls[] = {{{2.0, -9.0}, {2.0, 9.0}, WallSurface::kGlass}, {{3.0, -9.0}, {3.0, 9.0}}};
  EXPECT_NEAR(cast_ray(walls, {0.0, 0.0}, radians(5.0), 10.0)->distance_m, 2.0, 0.02);
  const auto behind = cast_ray(walls, {0.0, 0.0}, radians(20.0), 10.0);
  ASSERT_TRUE(behind);
  EXPECT_NEAR(behind->distance_m, 3.0 / std::cos(radians(20.0)), 1e-9);
}

TEST(WallsNear, KeepsAllOfWhichAPartIsWithinReach) {
  const WallSegment walls[] = {
      {{1.0, -50.0}, {1.0, 50.0}}, {{4.0, 0.0}, {5.0, 0.0}}, {{0.0, 2.0}, {0.0, 2.5}}};
  const std::vector<WallSegment> near = walls_near(walls, {0.0, 0.0}, 3.0);
  ASSERT_EQ(near.size(), 2U);
  EXPECT_EQ(near[0].start.x_m, 1.0);
  EXPECT_EQ(near[1].start.y_m, 2.0);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/wall_support.hpp"

#include <gmock/gmock.h>

#include <utility>

namespace swiftlet {
namespace {

using testing::FieldsAre;

constexpr double kResolutionM = 0.05;

/// That very wall.
auto is_the_same(const MapSegment& wall) {
  return FieldsAre(FieldsAre(wall.start_map.x_m, wall.start_map.y_m),
                   FieldsAre(wall.end_map.x_m, wall.end_map.y_m));
}

/// Occupied cells along the x axis, between two x in metres.
auto row_between(double low_m, double high_m) {
  return [=](CellIndex cell) {
    const double x_m = (cell.x + 0.5) * kResolutionM;
    return cell.y == 0 && x_m > low_m && x_m < high_m;
  };
}

TEST(WallSupport, KeepsAWallThatTheGridShowsThroughout) {
  const auto parts = supported_parts({{0.0, 0.02}, {2.0, 0.02}}, kResolutionM, row_between(-1.0, 3.0));
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_DOUBLE_EQ(parts[0].start_map.x_m, 0.0);
  EXPECT_DOUBLE_EQ(parts[0].end_map.x_m, 2.0);
}

TEST(WallSupport, CutsOffWhatReachesBeyond) {
  const auto parts = supported_parts({{0.0, 0.02}, {9.0, 0.02}}, kResolutionM, row_between(-1.0, 3.0));
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NEAR(parts[0].end_map.x_m, 3.0, 0.2);
}

TEST(WallSupport, BridgesAShortGapAndSplitsAtALongOne) {
  const auto with_gap = [](double low_m, double high_m) {
    return [=](CellIndex cell) { return row_between(-1.0, low_m)(cell) || row_between(high_m, 9.0)(cell); };
  };
  const MapSegment wall{{0.0, 0.02}, {5.0, 0.02}};
  EXPECT_EQ(supported_parts(wall, kResolutionM, with_gap(2.0, 2.3)).size(), 1U);
  EXPECT_EQ(supported_parts(wall, kResolutionM, with_gap(2.0, 3.0)).size(), 2U);
}

TEST(WallSupport, LeavesOutWhatOnlyCrossesAWall) {
  EXPECT_TRUE(supported_parts({{1.0, -2.0}, {1.0, 2.0}}, kResolutionM, row_between(-1.0, 3.0)).empty());
}

TEST(WallSupport, AWallWithoutLengthHasNoParts) {
  EXPECT_TRUE(supported_parts({{1.0, 0.0}, {1.0, 0.0}}, kResolutionM, row_between(-1.0, 3.0)).empty());
}

TEST(FittedToGrid, MovesAndTurnsAWallOntoTheOccupiedCells) {
  for (const auto& [start_y_m, end_y_m] : {std::pair{0.15, 0.15}, {-0.1, 0.05}, {0.02, 0.2}}) {
    const MapSegment fitted =
        fitted_to_grid({{0.5, start_y_m}, {2.5, end_y_m}}, kResolutionM, row_between(-1.0, 4.0));
    EXPECT_NEAR(fitted.start_map.y_m, 0.5 * kResolutionM, 0.02);
    EXPECT_NEAR(fitted.end_map.y_m, 0.5 * kResolutionM, 0.02);
    EXPECT_NEAR(fitted.start_map.x_m, 0.5, 0.02);
    EXPECT_NEAR(fitted.end_map.x_m, 2.5, 0.02);
  }
}

TEST(FittedToGrid, LeavesAWallAloneWithNothingNear) {
  for (const MapSegment& wall : {MapSegment{{0.5, 0.6}, {2.5, 0.6}}, MapSegment{{1.0, 0.0}, {1.0, 0.0}}}) {
    EXPECT_THAT(fitted_to_grid(wall, kResolutionM, row_between(-1.0, 4.0)), is_the_same(wall));
  }
}

TEST(FittedToGrid, TurnsNoWallIntoOneThatItCrosses) {
  const MapSegment wall{{1.0, -1.0}, {1.2, 1.0}};
  EXPECT_THAT(fitted_to_grid(wall, kResolutionM, row_between(-1.0, 4.0)), is_the_same(wall));
}

TEST(DistinctWalls, TellAWallSeenOnEveryPassOnce) {
  const std::vector<MapSegment> seen{
      {{0.0, 0.0}, {3.0, 0.05}}, {{0.2, 0.1}, {3.1, 0.1}}, {{0.0, -0.1}, {4.0, 0.0}}};
  const std::vector<MapSegment> told = distinct_walls(seen);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].end_map.x_m, 4.0);
}

TEST(DistinctWalls, KeepWhatAnotherPassSawFurtherOn) {
  const std::vector<MapSegment> told = distinct_walls({{{0.0, 0.0}, {3.0, 0.0}}, {{2.0, 0.1}, {4.5, 0.1}}});
  ASSERT_EQ(told.size(), 2U);
  EXPECT_NEAR(told[1].start_map.x_m, 3.25, 0.1);
  EXPECT_NEAR(told[1].end_map.x_m, 4.5, 1e-9);
}

TEST(DistinctWalls, KeepCornersAndTheOtherSideOfACorridor) {
  const std::vector<MapSegment> walls{
      {{0.0, 0.0}, {3.0, 0.0}}, {{0.0, 0.0}, {0.0, 2.0}}, {{0.0, 1.5}, {2.0, 1.5}}};
  EXPECT_EQ(distinct_walls(walls).size(), 3U);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/ranger.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace swiftlet {
namespace {

WallSegment wall_across(double x_m) { return {{x_m, -20.0}, {x_m, 20.0}}; }

ConeReturn look(const std::vector<WallSegment>& walls) {
  const std::optional<ConeReturn> seen = look_through_cone(walls, {0.0, 0.0}, 0.0, RangerModel{});
  EXPECT_TRUE(seen);
  return seen.value_or(ConeReturn{});
}

double lost_share(const std::vector<WallSegment>& walls) {
  NoiseSource noise(1, "range");
  int lost = 0;
  for (int i = 0; i < 4000; ++i) lost += measure_range(walls, {0.0, 0.0}, 0.0, RangerModel{}, noise) ? 0 : 1;
  return lost / 4000.0;
}

TEST(Cone, IsCalibratedForAWallMetSquarely) {
  for (const double distance_m : {0.2, 1.0, 2.0, 3.0}) {
    EXPECT_NEAR(look({wall_across(distance_m)}).distance_m, distance_m, 1e-9);
    EXPECT_NEAR(look({wall_across(distance_m)}).dimness_m, distance_m, 1e-9);
  }
}

TEST(Cone, SeesAPostBesideItsAxisBeforeTheWallBehind) {
  // 4 degrees off the axis, 1 m away; the wall at 2.5 m is too far behind to merge.
  const WallSegment post{{1.0, 0.05}, {1.0, 0.09}};
  EXPECT_NEAR(look({wall_across(2.5), post}).distance_m, 1.0, 0.03);
}

TEST(Cone, IgnoresAPostOutsideIt) {
  const WallSegment post{{1.0, 0.10}, {1.0, 0.40}};  // from 5.7 degrees
  EXPECT_NEAR(look({wall_across(2.5), post}).distance_m, 2.5, 1e-9);
}

TEST(Cone, MergesWhatLiesCloseTogetherTowardsTheNearer) {
  const WallSegment step{{2.0, 0.0}, {2.0, 20.0}};
  const double seen_m = look({step, {{2.3, -20.0}, {2.3, 0.0}}}).distance_m;
  EXPECT_GT(seen_m, 2.0);
  EXPECT_LT(seen_m, 2.15);
}

/// A long wall that the axis meets 1.5 m away.
WallSegment met_at(double incidence_rad) {
  const double dx = 10.0 * std::sin(incidence_rad);
  const double dy = 10.0 * std::cos(incidence_rad);
  return {{1.5 - dx, -dy}, {1.5 + dx, dy}};
}

TEST(Cone, ReadsObliqueWallsLittleShort) {
  EXPECT_NEAR(look({met_at(radians(35))}).distance_m / 1.5, 1.000, 0.002);
  EXPECT_NEAR(look({met_at(radians(55))}).distance_m / 1.5, 0.994, 0.003);
  EXPECT_NEAR(look({met_at(radians(65))}).distance_m / 1.5, 0.975, 0.005);
  EXPECT_GT(look({met_at(radians(55))}).dimness_m, 1.8);
}

TEST(Cone, ReceivesNothingFromBeyondTheLimit) {
  const std::vector<WallSegment> walls{wall_across(3.7)};
  EXPECT_FALSE(look_through_cone(walls, {0.0, 0.0}, 0.0, RangerModel{}));
}

TEST(MeasureRange, ScattersByOneCentimetreAndOnePercent) {
  const std::vector<WallSegment> walls{wall_across(2.0)};
  NoiseSource noise(1, "range");
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  for (int i = 0; i < 10000; ++i) {
    const auto range_m = measure_range(walls, {0.0, 0.0}, 0.0, RangerModel{}, noise);
    if (!range_m) continue;
    const double error_m = *range_m - 2.0;
    sum += error_m;
    squares += error_m * error_m;
    ++count;
  }
  EXPECT_NEAR(sum / count, 0.0, 4.0 * 0.03 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), 0.03, 0.001);
}

TEST(MeasureRange, LosesMoreTheFartherAndTheMoreObliqueTheWall) {
  EXPECT_LT(lost_share({wall_across(1.0)}), 0.01);
  EXPECT_LT(lost_share({wall_across(2.0)}), 0.03);
  EXPECT_NEAR(lost_share({wall_across(3.0)}), 0.5, 0.05);
  EXPECT_GT(lost_share({wall_across(3.5)}), 0.9);
  const WallSegment oblique{{0.5, 2.0 * std::sqrt(3.0)}, {2.5, -2.0 / std::sqrt(3.0)}};
  EXPECT_GT(lost_share({wall_across(2.6)}), lost_share({wall_across(2.2)}));
  const WallSegment grazed{{2.6 - 8.0, 2.0}, {2.6 + 8.0, -2.0}};
  EXPECT_GT(lost_share({grazed}), lost_share({oblique}) + 0.01);
}

TEST(MeasureRange, DrawsTheSameNoiseWhetherReadingsWereLostOrNot) {
  NoiseSource after_hit(1, "range");
  NoiseSource after_nothing(1, "range");
  const std::vector<WallSegment> near{wall_across(1.0)};
  ASSERT_TRUE(measure_range(near, {0.0, 0.0}, 0.0, RangerModel{}, after_hit));
  ASSERT_FALSE(measure_range({}, {0.0, 0.0}, 0.0, RangerModel{}, after_nothing));
  EXPECT_EQ(measure_range(near, {0.0, 0.0}, 0.0, RangerModel{}, after_hit),
            measure_range(near, {0.0, 0.0}, 0.0, RangerModel{}, after_nothing));
}

TEST(MeasureRange, LosesDarkWallsAtShorterDistance) {
  WallSegment dark = wall_across(2.0);
  dark.surface = WallSurface::kDark;
  EXPECT_GT(lost_share({dark}), 0.5);
  EXPECT_LT(lost_share({wall_across(2.0)}), 0.05);
}

TEST(LoggedRange, IsTheMillimetresThatTheFirmwareShows) {
  EXPECT_EQ(logged_range_mm(1.234), 1234.0);
  EXPECT_EQ(logged_range_mm(0.0), 0.0);
  EXPECT_EQ(logged_range_mm(0.251), 250.0);
  EXPECT_EQ(logged_range_mm(0.502), 501.0);
  EXPECT_EQ(logged_range_mm(1.004), 1003.0);
  EXPECT_EQ(logged_range_mm(std::nullopt), 32766.0);
  int one_short = 0;
  for (int mm = 0; mm < 4000; ++mm) one_short += logged_range_mm(mm / 1000.0) < mm ? 1 : 0;
  EXPECT_EQ(one_short, 21);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/tilt.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

TEST(SimulatedTilt, IsThatOfTheMotionWithoutAModel) {
  SimulatedTilt tilt({}, 1);
  for (int i = 0; i < 100; ++i) tilt.step({0.1, 0.2});
  EXPECT_EQ(tilt.now().roll_rad, 0.1);
  EXPECT_EQ(tilt.now().pitch_rad, 0.2);
}

TEST(SimulatedTilt, IsSmallMostOfTheTimeAndLargeInGusts) {
  SimulatedTilt tilt({.calm_rad = radians(1.15), .gust_rad = radians(5.3)}, 1);
  std::vector<double> degrees_tilted;
  for (int i = 0; i < 100'000; ++i) {
    tilt.step({});
    degrees_tilted.push_back(degrees(std::hypot(tilt.now().roll_rad, tilt.now().pitch_rad)));
  }
  std::ranges::sort(degrees_tilted);
  EXPECT_NEAR(degrees_tilted[50'000], 1.6, 0.3);
  EXPECT_NEAR(degrees_tilted[95'000], 7.0, 2.0);
}

TEST(SimulatedTilt, AddsWhatTheMotionAsksForAndRemembersASecond) {
  SimulatedTilt tilt({.calm_rad = radians(0.001)}, 1);
  for (int i = 0; i < 50; ++i) tilt.step({.roll_rad = 0.1, .pitch_rad = -0.2});
  for (int i = 0; i < 10; ++i) tilt.step({});
  EXPECT_NEAR(tilt.now().roll_rad, 0.0, 1e-3);
  EXPECT_NEAR(tilt.before(milliseconds(90)).pitch_rad, 0.0, 1e-3);
  EXPECT_NEAR(tilt.before(milliseconds(100)).pitch_rad, -0.2, 1e-3);
  EXPECT_NEAR(tilt.before(milliseconds(-50)).pitch_rad, 0.0, 1e-3) << "a time ahead counts as now";
}

TEST(TiltedRange, GrowsWithTheCosineAndEndsAtTheFloor) {
  const Tilt nose_down{.pitch_rad = radians(10.0)};
  EXPECT_NEAR(tilted_range_m(2.0, 0.0, nose_down, 0.5).value_or(0.0), 2.0 / std::cos(radians(10.0)), 1e-9);
  EXPECT_NEAR(tilted_range_m(2.0, 0.0, nose_down, 0.2).value_or(0.0), 0.2 / std::sin(radians(10.0)), 1e-9);
  EXPECT_NEAR(tilted_range_m(2.0, kPi, nose_down, 0.2).value_or(0.0), 2.0 / std::cos(radians(10.0)), 1e-9);
  EXPECT_NEAR(tilted_range_m(2.0, kPi / 2.0, nose_down, 0.2).value_or(0.0), 2.0, 1e-9);
}

TEST(TiltedRange, ShowsTheFloorWhereThereWasNoReturn) {
  EXPECT_FALSE(tilted_range_m(std::nullopt, 0.0, {}, 0.5));
  EXPECT_TRUE(tilted_range_m(std::nullopt, kPi / 2.0, {.roll_rad = radians(-15.0)}, 0.5)) << "left side down";
  EXPECT_FALSE(tilted_range_m(std::nullopt, -kPi / 2.0, {.roll_rad = radians(-15.0)}, 0.5));
}

}  // namespace
}  // namespace swiftlet

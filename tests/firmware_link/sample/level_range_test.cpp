// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/level_range.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "core/geometry/angle.hpp"
#include "firmware_link/simulation/tilt.hpp"

namespace swiftlet {
namespace {

/// The simulated beam is the other way round: from the plane to the slope.
TEST(LevelRange, UndoesWhatATiltedBeamMeasures) {
  for (const double bearing_rad : {0.0, kPi / 2.0, kPi, -kPi / 2.0}) {
    const Tilt tilt{.roll_rad = radians(12.0), .pitch_rad = radians(-7.0)};
    const std::optional<double> slope_m = tilted_range_m(2.0, bearing_rad, tilt, 10.0);
    ASSERT_TRUE(slope_m);
    EXPECT_GT(*slope_m, 2.005);
    const double rise = rise_of_beam(bearing_rad, tilt_of(tilt.roll_rad, -tilt.pitch_rad));
    EXPECT_NEAR(level_range_m(*slope_m, rise), 2.0, 2e-3) << bearing_rad;
  }
}

TEST(LevelRange, ABeamThatPointsDownFarEnoughCanBeTheFloors) {
  const double down_10_deg = rise_of_beam(0.0, tilt_of(0.0, radians(-10.0)));
  EXPECT_TRUE(can_be_floor(0.5 / std::sin(radians(10.0)), down_10_deg, 0.5));
  EXPECT_TRUE(can_be_floor(2.5, down_10_deg, 0.5)) << "it may point down by more";
  EXPECT_FALSE(can_be_floor(2.0, down_10_deg, 0.5));
  EXPECT_FALSE(can_be_floor(3.5, -down_10_deg, 0.5)) << "it points up";
  EXPECT_FALSE(can_be_floor(3.5, 0.0, 0.5));
}

}  // namespace
}  // namespace swiftlet

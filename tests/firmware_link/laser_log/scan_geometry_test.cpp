// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/laser_log/scan_geometry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;

TEST(PickBeams, FollowsThePapersRule) {
  EXPECT_THAT(pick_beams(180, 11), ElementsAre(0, 18, 36, 54, 72, 90, 108, 126, 144, 162, 179));
  EXPECT_THAT(pick_beams(180, 4), ElementsAre(0, 60, 120, 179));
  EXPECT_THAT(pick_beams(181, 2), ElementsAre(0, 180));
  EXPECT_EQ(pick_beams(180, 61)[59], 177U);
}

TEST(PickBeams, LeavesNoSectorWithoutBeams) {
  for (const std::size_t readings : {180U, 181U, 360U, 361U, 541U, 682U, 1081U}) {
    for (std::size_t beams = 2; beams <= 64; ++beams) {
      const std::vector<std::size_t> picked = pick_beams(readings, beams);
      ASSERT_EQ(picked.size(), beams);
      EXPECT_EQ(picked.front(), 0U);
      EXPECT_EQ(picked.back(), readings - 1);
      const double even = static_cast<double>(readings - 1) / static_cast<double>(beams - 1);
      for (std::size_t i = 1; i < beams; ++i) {
        ASSERT_GT(picked[i], picked[i - 1]);
        EXPECT_LT(static_cast<double>(picked[i] - picked[i - 1]), 1.55 * even + 1.0)
            << readings << ", " << beams;
      }
    }
  }
}

TEST(UsualGeometry, LooksAheadEvenlyToBothSides) {
  for (const std::size_t readings : {181U, 361U, 401U, 541U, 682U, 683U, 1081U}) {
    const auto geometry = usual_geometry(readings);
    ASSERT_TRUE(geometry) << readings;
    EXPECT_NEAR(geometry->bearing_rad(0), -geometry->bearing_rad(readings - 1), geometry->step_rad);
  }
  EXPECT_FALSE(usual_geometry(90));
}

TEST(ReadingsAlong, AreTheNearest) {
  BeamLayout beams;
  beams.count = 4;
  beams.bearing_rad[0] = radians(-90.3);
  beams.bearing_rad[1] = radians(0.2);
  beams.bearing_rad[2] = radians(90.0);
  beams.bearing_rad[3] = radians(179.0);
  EXPECT_THAT(readings_along(beams, *usual_geometry(181)), ElementsAre(0, 90, 180, kNoReading));
  const ScanGeometry around{.readings = 360, .start_rad = 0.0, .step_rad = radians(1.0)};
  EXPECT_THAT(readings_along(beams, around), ElementsAre(270, 0, 90, 179));
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/benchmarks/true_walls.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace swiftlet {
namespace {

/// A wall of 4 m, seen from below by scans 0 and 1 and from above by scan 2.
class TrueWallsTest : public testing::Test {
 protected:
  TrueWallsTest() {
    for (std::uint32_t scan = 0; scan < 3; ++scan)
      for (int k = 0; k < 6; ++k)
        hits_.push_back({scan, {}, {scan == 2 ? -1.0 : 1.0, 0.3 * k - 0.75 + off_m_[scan]}});
  }
  [[nodiscard]] std::vector<DrawnReturn> drawn_at(std::span<const Pose2> T_map_body) const {
    std::vector<DrawnReturn> drawn;
    for (const ScanHit& hit : hits_) {
      const Pose2& T = T_map_body[hit.scan];
      const Point2 beam{T.cos_yaw() * (hit.p_body.x_m < 0.0 ? -1.0 : 1.0),
                        T.sin_yaw() * (hit.p_body.x_m < 0.0 ? -1.0 : 1.0)};
      drawn.push_back({T * hit.p_body, beam});
    }
    return drawn;
  }

  const double off_m_[3] = {0.0, 0.1, 0.0};
  const std::vector<WallSegment> walls_{{{-2.0, 1.0}, {2.0, 1.0}}, {{-2.0, 6.0}, {2.0, 6.0}}};
  const Pose2 up_{0.0, 0.0, 1.5707963267948966};
  const std::vector<Pose2> truth_{up_, up_, Pose2(0.0, 2.0, up_.yaw_rad())};
  std::vector<ScanHit> hits_;
};

TEST_F(TrueWallsTest, ReturnsOnOneFaceShareAPatchWhereverTheyAreDrawn) {
  const TrueWalls walls(walls_, hits_, truth_);
  const std::vector<Pose2> off{up_, Pose2(0.0, 0.4, up_.yaw_rad()), truth_[2]};
  const WallPatches found = walls.drawn_by(drawn_at(off), {});
  ASSERT_EQ(found.patches.size(), 2U) << "two faces; nobody saw the other wall";
  EXPECT_EQ(found.patch_of[0], found.patch_of[6]);
  EXPECT_NE(found.patch_of[0], found.patch_of[12]);
  const WallPatch& seen_from_below = found.patches[found.patch_of[0]];
  EXPECT_NEAR(seen_from_below.center_map.y_m, 1.2, 1e-9) << "the mean of what was drawn, not the true wall";
  EXPECT_NEAR(seen_from_below.normal_map.y_m, -1.0, 0.05) << "towards the sensor";
}

TEST_F(TrueWallsTest, AReturnFarFromEveryWallIsOnNone) {
  hits_[3].p_body.x_m = 1.2;
  const WallPatches found = TrueWalls(walls_, hits_, truth_).drawn_by(drawn_at(truth_), {});
  EXPECT_EQ(found.patch_of[3], WallPatches::kNone);
  EXPECT_NE(found.patch_of[2], WallPatches::kNone);
}

TEST_F(TrueWallsTest, WhatIsTooShortToShowItsDirectionHasThatOfItsWall) {
  hits_.resize(1);
  const WallPatches found = TrueWalls(walls_, hits_, truth_).drawn_by(drawn_at(truth_), {});
  ASSERT_EQ(found.patches.size(), 1U);
  EXPECT_NEAR(found.patches[0].normal_map.x_m, 0.0, 1e-9);
  EXPECT_NEAR(found.patches[0].normal_map.y_m, -1.0, 1e-9);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/mended_odometry.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/pose_near.hpp"

namespace swiftlet {
namespace {

HostTime at_ms(int ms) { return HostTime(std::chrono::milliseconds(ms)); }

TEST(MendedOdometry, BeforeTheFirstRecordAllIsAsReported) {
  const Pose2 T_odom_body(1.0, 2.0, 0.3);
  const std::vector<MendedOdometry> mended{{at_ms(10), Pose2(1.0, 0.0, 0.5)}};
  EXPECT_EQ(as_reported(mended, at_ms(9), T_odom_body).vector(), T_odom_body.vector());
  EXPECT_TRUE(poses_near(as_reported(mended, at_ms(10), Pose2(1.0, 0.0, 0.5) * T_odom_body), T_odom_body,
                         1e-9, 1e-9));
}

TEST(MendedOdometry, WhatWasMendedTwiceIsGivenBackInTurn) {
  const std::vector<MendedOdometry> first{{at_ms(10), Pose2(1.0, 0.0, 0.5)},
                                          {at_ms(30), Pose2(0.0, 2.0, -0.4)}};
  const std::vector<MendedOdometry> then{{at_ms(20), Pose2(0.0, 1.0, 0.0), true},
                                         {at_ms(30), Pose2(0.0, 3.0, 0.0)},
                                         {at_ms(40), Pose2(4.0, 3.0, 0.0), true}};
  const std::vector<MendedOdometry> both = mended_in_turn(first, then);
  ASSERT_EQ(both.size(), 4U) << "one of both at 30";
  const Pose2 T_odom_body(1.0, 2.0, 0.3);
  for (const int ms : {5, 10, 15, 20, 25, 30, 35, 40, 50})
    EXPECT_TRUE(poses_near(as_reported(both, at_ms(ms), T_odom_body),
                           as_reported(first, at_ms(ms), as_reported(then, at_ms(ms), T_odom_body)), 1e-9,
                           1e-9))
        << ms;
  EXPECT_EQ((std::vector{both[0].reversed, both[1].reversed, both[2].reversed, both[3].reversed}),
            (std::vector{false, true, false, true}));
  EXPECT_TRUE(mended_in_turn({}, {}).empty());
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/evaluation/stamped_path.hpp"

#include <gmock/gmock.h>

#include <chrono>

namespace swiftlet {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;

TEST(StampedPath, FindsTheNearestPoseWithinTwoMilliseconds) {
  const StampedPath path({{HostTime(seconds(1)), Pose2()},
                          {HostTime(milliseconds(1003)), Pose2(1.0, 0.0, 0.0)},
                          {HostTime(seconds(2)), Pose2()}});
  EXPECT_EQ(path.nearest(HostTime(microseconds(1'001'400))), path.poses().data());
  EXPECT_EQ(path.nearest(HostTime(microseconds(1'001'600))), &path.poses()[1]);
  EXPECT_EQ(path.nearest(HostTime(microseconds(1'001'500))), path.poses().data())
      << "the earlier of two as near";
  EXPECT_EQ(path.nearest(HostTime(milliseconds(998))), path.poses().data());
  EXPECT_EQ(path.nearest(HostTime(milliseconds(2002))), &path.poses()[2]);
  EXPECT_EQ(path.nearest(HostTime(microseconds(997'999))), nullptr);
  EXPECT_EQ(path.nearest(HostTime(microseconds(2'002'001))), nullptr);
  EXPECT_EQ(path.nearest(HostTime(microseconds(1'500'000))), nullptr);
  EXPECT_EQ(StampedPath({}).nearest(HostTime(seconds(1))), nullptr);
}

TEST(StampedPath, SortsItsPosesAndFindsTheFirstOfEqualStamps) {
  const StampedPath path({{HostTime(seconds(2)), Pose2(2.0, 0.0, 0.0)},
                          {HostTime(seconds(1)), Pose2(1.0, 0.0, 0.0)},
                          {HostTime(seconds(2)), Pose2(3.0, 0.0, 0.0)}});
  EXPECT_EQ(path.poses().front().pose.x_m(), 1.0);
  EXPECT_EQ(path.nearest(HostTime(seconds(2)))->pose.x_m(), 2.0);
  EXPECT_EQ(path.nearest(HostTime(milliseconds(2001)))->pose.x_m(), 2.0);
  EXPECT_EQ(path.interpolated(HostTime(seconds(2))).x_m(), 2.0);
}

TEST(StampedPath, InterpolatesInTimeAndTurnsTheShortWayRound) {
  const StampedPath path({{HostTime(seconds(0)), Pose2(1.0, -2.0, radians(170.0))},
                          {HostTime(seconds(4)), Pose2(3.0, 2.0, radians(-150.0))}});
  const Pose2 pose = path.interpolated(HostTime(seconds(3)));
  EXPECT_NEAR(pose.x_m(), 2.5, 1e-12);
  EXPECT_NEAR(pose.y_m(), 1.0, 1e-12);
  EXPECT_NEAR(degrees(pose.yaw_rad()), -160.0, 1e-9);
}

TEST(StampedPath, StandsStillBeyondItsEnds) {
  const StampedPath path(
      {{HostTime(seconds(1)), Pose2(1.0, 0.0, 0.0)}, {HostTime(seconds(2)), Pose2(2.0, 0.0, 0.0)}});
  EXPECT_EQ(path.interpolated(HostTime(seconds(0))).x_m(), 1.0);
  EXPECT_EQ(path.interpolated(HostTime(seconds(9))).x_m(), 2.0);
}

TEST(MatchStamps, TellsExactFromNearFromUnmatchedAndCountsEachStampOnce) {
  const StampedPath path({{HostTime(seconds(1)), Pose2()}, {HostTime(seconds(2)), Pose2()}});
  const StampMatching matching =
      match_stamps({HostTime(seconds(3)), HostTime(seconds(1)), HostTime(seconds(1) - microseconds(10)),
                    HostTime(seconds(1)), HostTime(seconds(2) + microseconds(11)),
                    HostTime(milliseconds(1500)), HostTime(seconds(3))},
                   path);
  EXPECT_EQ(matching.exact, 2U);
  EXPECT_EQ(matching.near, 1U);
  EXPECT_THAT(matching.unmatched, ElementsAre(HostTime(milliseconds(1500)), HostTime(seconds(3))));
}

}  // namespace
}  // namespace swiftlet

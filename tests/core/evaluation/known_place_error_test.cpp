// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/evaluation/known_place_error.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <numeric>

namespace swiftlet {
namespace {

HostTime at_second(int second) { return HostTime(std::chrono::seconds(second)); }

/// Out along x at 1 m/s to 30 m, and back, a keyframe a metre. The map is moved and turned; on the way back
/// the pose is off by `off_m` to the left of the way out.
struct OutAndBack {
  explicit OutAndBack(double off_m) {
    for (int second = 0; second <= 60; ++second) {
      const double x_m = second <= 30 ? second : 60 - second;
      const Pose2 T_world_body(x_m, 0.0, second <= 30 ? 0.0 : kPi);
      const Pose2 T_map_body = T_map_world * Pose2(x_m, second <= 30 ? 0.0 : off_m, T_world_body.yaw_rad());
      moments.push_back(
          {at_second(second), double(second), T_map_body, T_map_body, T_world_body, Point2{0.0, 1.0}});
      keyframes.push_back({double(second), {{at_second(second), T_map_body}}, {}, T_world_body});
    }
  }
  [[nodiscard]] KnownPlaceError error() const { return known_place_error(moments, keyframes); }

  Pose2 T_map_world{3.0, -7.0, 1.2};
  std::vector<LiveMoment> moments;
  std::vector<PublishedKeyframe> keyframes;
};

TEST(KnownPlaceError, IsZeroWhereTheWholeMapIsOnlyMovedAndTurned) {
  const KnownPlaceError error = OutAndBack(0.0).error();
  EXPECT_EQ(error.moments, 22U) << "from 39 s on: keyframes of 19 s and before lie within 3 m";
  EXPECT_NEAR(error.max_m, 0.0, 1e-9);
  EXPECT_EQ(error.share_off, 0.0);
  EXPECT_EQ(error.contacts, 1U);
  EXPECT_EQ(error.contacts_off, 0U);
  EXPECT_NEAR(error.map_rms_m[0].value(), 0.0, 1e-9);
}

TEST(KnownPlaceError, IsThatOfThePoseBesideTheOlderMap) {
  const KnownPlaceError error = OutAndBack(0.5).error();
  EXPECT_NEAR(error.rms_m, 0.5, 1e-9);
  EXPECT_NEAR(error.p95_m, 0.5, 1e-9);
  EXPECT_EQ(error.share_off, 1.0);
  EXPECT_NEAR(error.across_p95_m.value(), 0.5, 1e-9) << "the wall runs along the way";
  EXPECT_NEAR(error.along_p95_m.value(), 0.0, 1e-9);
  EXPECT_EQ(error.contacts_off, 1U);
  EXPECT_NEAR(error.settled_p50_s, 60 - 39, 1e-9) << "never: to the end";
  EXPECT_NEAR(error.map_rms_m[1].value(), 0.5, 1e-9) << "at 5 m";
}

TEST(KnownPlaceError, KeepsWhatItsFiguresAreOf) {
  OutAndBack run(0.5);
  run.moments.back().wall_normal_world.reset();
  const KnownPlaceError error = run.error();
  EXPECT_EQ(error.errors.size(), 22U);
  ASSERT_EQ(error.across_m.size(), 21U) << "the last has no wall near";
  EXPECT_EQ(error.along_m.size(), 21U);
  EXPECT_NEAR(std::reduce(error.across_m.begin(), error.across_m.end()), 21 * 0.5, 1e-9);
  EXPECT_EQ(error.settled_s, std::vector{21.0});
}

TEST(KnownPlaceError, HoldsThePoseAgainstTheMapOfThatMoment) {
  OutAndBack run(0.5);
  for (PublishedKeyframe& keyframe : run.keyframes)  // at 50 s the older map is moved to the pose
    if (keyframe.path_m <= 30.0)
      keyframe.T_map_body.push_back(
          {at_second(50), run.T_map_world * Pose2(keyframe.path_m, 0.5, keyframe.T_world_body.yaw_rad())});
  const KnownPlaceError error = run.error();
  EXPECT_NEAR(error.max_m, 0.5, 1e-9);
  EXPECT_NEAR(error.share_off, 12.0 / 22.0, 1e-9) << "what is published at 50 s holds from then on";
  EXPECT_NEAR(error.settled_p50_s, 51 - 39, 1e-9);
}

TEST(KnownPlaceError, LeavesOutWhatTheMapHasLost) {
  OutAndBack run(0.5);
  for (PublishedKeyframe& keyframe : run.keyframes) keyframe.erased = at_second(45);
  EXPECT_EQ(run.error().moments, 7U) << "39 to 45 s";
}

TEST(KnownPlaceError, WhatLiesOnAnotherStoreyIsNoKnownPlace) {
  OutAndBack run(0.5);
  for (std::size_t i = 31; i < run.moments.size(); ++i) run.moments[i].storey = StoreyId{1};
  EXPECT_EQ(run.error().moments, 0U);
}

TEST(KnownPlaceError, CountsJumpsAgainstTheContinuousFrame) {
  OutAndBack run(0.5);
  EXPECT_EQ(run.error().jumps, 0U) << "all of it was flown";
  for (LiveMoment& moment : run.moments) moment.T_local_body = moment.T_world_body;
  const KnownPlaceError error = run.error();
  EXPECT_EQ(error.jumps, 1U);
  EXPECT_NEAR(error.greatest_jump_m, 0.5, 1e-9);
}

TEST(KnownPlaceError, OfAFlightWithoutAKnownPlaceIsNone) {
  OutAndBack run(0.5);
  run.moments.resize(30);
  EXPECT_EQ(run.error().moments, 0U);
  EXPECT_FALSE(run.error().across_p95_m.has_value());
  EXPECT_EQ(known_place_error({}, {}).moments, 0U);
}

}  // namespace
}  // namespace swiftlet

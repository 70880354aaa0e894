// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/odometry_drift.hpp"

#include <gtest/gtest.h>

#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

constexpr double kMinimum = radians(0.5);
constexpr double kNoiseVariance = radians(0.3) * radians(0.3);

TEST(OdometryDrift, IsNoneBeforeAnythingWasLearnt) {
  EXPECT_EQ(OdometryDrift(kMinimum).yaw_per_metre_rad(), 0.0);
}

TEST(OdometryDrift, FindsASystematicYaw) {
  test::RandomGeometry random(1);
  for (const double truth : {radians(2.5), radians(-1.5)}) {
    OdometryDrift drift(kMinimum);
    for (int i = 0; i < 200; ++i) drift.learn(0.5, 0.5 * truth + random.normal(radians(0.3)), kNoiseVariance);
    EXPECT_NEAR(drift.yaw_per_metre_rad(), truth, radians(0.3));
  }
}

TEST(OdometryDrift, LeavesACalibratedVehicleAlone) {
  test::RandomGeometry random(2);
  OdometryDrift drift(kMinimum);
  for (int i = 0; i < 1000; ++i) {
    drift.learn(0.5, random.normal(radians(0.3)), kNoiseVariance);
    ASSERT_EQ(drift.yaw_per_metre_rad(), 0.0) << "after " << i;
  }
}

TEST(OdometryDrift, LearnsNothingFromTurningOnTheSpotOrFromUnknownMotion) {
  OdometryDrift drift(kMinimum);
  for (int i = 0; i < 100; ++i) drift.learn(0.0, 0.5, kNoiseVariance);
  for (int i = 0; i < 100; ++i) drift.learn(0.5, 0.5, 1e6);
  EXPECT_EQ(drift.yaw_per_metre_rad(), 0.0);
}

TEST(OdometryDrift, FollowsAChange) {
  OdometryDrift drift(kMinimum);
  for (int i = 0; i < 300; ++i) drift.learn(0.5, 0.5 * radians(2.0), kNoiseVariance);
  for (int i = 0; i < 500; ++i) drift.learn(0.5, 0.5 * radians(-2.0), kNoiseVariance);
  EXPECT_NEAR(drift.yaw_per_metre_rad(), radians(-2.0), radians(0.2));
}

}  // namespace
}  // namespace swiftlet

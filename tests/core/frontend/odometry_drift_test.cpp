// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/odometry_drift.hpp"

#include <gtest/gtest.h>

#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

constexpr double kNoiseVariance = radians(0.3) * radians(0.3);

OdometryDrift usual_drift() { return OdometryDrift(SensorModel::carmen_laser().odometry); }

TEST(OdometryDrift, IsNeverFoundWhereTheSensorHasNone) {
  OdometryDrift drift(SensorModel::crazyflie().odometry);
  for (int i = 0; i < 100; ++i) drift.update(0.5, 0.2, 0.1, kNoiseVariance);
  EXPECT_EQ(drift.yaw_correction_rad(1.0, 1.0), 0.0);
}

TEST(OdometryDrift, IsNoneBeforeAnythingWasLearnt) {
  EXPECT_EQ(usual_drift().yaw_correction_rad(1.0, 1.0), 0.0);
}

TEST(OdometryDrift, BeginsAtWhatIsExpectedAndLearnsOn) {
  OdometryNoise noise = SensorModel::carmen_laser().odometry;
  noise.expected_drift_yaw_per_metre_rad = radians(3.0);
  noise.expected_drift_yaw_per_radian = -0.02;
  OdometryDrift drift(noise);
  EXPECT_DOUBLE_EQ(drift.yaw_correction_rad(2.0, 0.0), radians(6.0));
  EXPECT_DOUBLE_EQ(drift.yaw_correction_rad(0.0, 1.0), -0.02);
  for (int i = 0; i < 200; ++i) drift.update(0.5, 0.0, 0.5 * radians(1.0), kNoiseVariance);
  EXPECT_NEAR(drift.yaw_correction_rad(1.0, 0.0), radians(1.0), radians(0.2));
}

TEST(OdometryDrift, FindsASystematicYaw) {
  test::RandomGeometry random(1);
  for (const double truth : {radians(2.5), radians(-1.5)}) {
    OdometryDrift drift = usual_drift();
    for (int i = 0; i < 200; ++i)
      drift.update(0.5, 0.0, 0.5 * truth + random.normal(radians(0.3)), kNoiseVariance);
    EXPECT_NEAR(drift.yaw_correction_rad(1.0, 0.0), truth, radians(0.4));
  }
}

TEST(OdometryDrift, TellsYawPerMetreFromAShareOfTheTurns) {
  test::RandomGeometry random(3);
  constexpr double kPerMetre = radians(1.5);
  constexpr double kPerRadian = -0.05;
  OdometryDrift drift = usual_drift();
  for (int i = 0; i < 600; ++i) {
    const double turn_rad = i % 3 == 0 ? radians(30.0) : 0.0;
    const double error_rad = 0.4 * kPerMetre + turn_rad * kPerRadian + random.normal(radians(0.2));
    drift.update(0.4, turn_rad, error_rad, kNoiseVariance);
  }
  EXPECT_NEAR(drift.yaw_correction_rad(1.0, 0.0), kPerMetre, radians(0.4));
  EXPECT_NEAR(drift.yaw_correction_rad(0.0, 1.0), kPerRadian, 0.02);
}

TEST(OdometryDrift, LeavesACalibratedVehicleAlone) {
  test::RandomGeometry random(2);
  OdometryDrift drift = usual_drift();
  for (int i = 0; i < 1000; ++i) {
    drift.update(0.5, 0.0, random.normal(radians(0.3)), kNoiseVariance);
    ASSERT_NEAR(drift.yaw_correction_rad(1.0, 0.0), 0.0, radians(0.6)) << "after " << i;
  }
}

TEST(OdometryDrift, LearnsNothingFromStandingStillOrFromUnknownMotion) {
  OdometryDrift drift = usual_drift();
  for (int i = 0; i < 100; ++i) drift.update(0.0, 0.0, 0.5, kNoiseVariance);
  EXPECT_EQ(drift.yaw_correction_rad(1.0, 1.0), 0.0);
  for (int i = 0; i < 100; ++i) drift.update(0.5, 0.0, 0.5, 1e6);
  EXPECT_NEAR(drift.yaw_correction_rad(1.0, 0.0), 0.0, 1e-6);
}

TEST(OdometryDrift, FollowsAChange) {
  OdometryDrift drift = usual_drift();
  for (int i = 0; i < 300; ++i) drift.update(0.5, 0.0, 0.5 * radians(2.0), kNoiseVariance);
  for (int i = 0; i < 500; ++i) drift.update(0.5, 0.0, 0.5 * radians(-2.0), kNoiseVariance);
  EXPECT_NEAR(drift.yaw_correction_rad(1.0, 0.0), radians(-2.0), radians(0.2));
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/odometry_covariance.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

TEST(UncertainStep, HasNoErrorWhenTheVehicleStandsStill) {
  EXPECT_TRUE(uncertain_step(OdometryNoise(), Pose2()).covariance.isZero(0.0));
}

TEST(UncertainStep, GrowsWithDistanceAndTurnAsTheModelSays) {
  const OdometryNoise noise;
  const UncertainMotion step = uncertain_step(noise, Pose2(0.3, -0.4, -0.2));
  const double sigma_xy = noise.xy_floor_m + 0.5 * noise.xy_per_metre + 0.2 * noise.xy_per_radian_m;
  const double sigma_yaw = noise.yaw_floor_rad + 0.2 * noise.yaw_per_radian + 0.5 * noise.yaw_per_metre_rad;
  EXPECT_DOUBLE_EQ(step.covariance(0, 0), sigma_xy * sigma_xy);
  EXPECT_DOUBLE_EQ(step.covariance(1, 1), sigma_xy * sigma_xy);
  EXPECT_DOUBLE_EQ(step.covariance(2, 2), sigma_yaw * sigma_yaw);
  EXPECT_EQ(step.covariance(0, 2), 0.0);
}

TEST(UnwatchedStep, IsMoreUncertainTheLongerNobodyWatched) {
  const OdometryNoise noise = SensorModel::crazyflie().odometry;
  const Pose2 T(0.3, 0.1, 0.2);
  const UncertainMotion watched = uncertain_step(noise, T);
  const UncertainMotion brief = unwatched_step(noise, T, std::chrono::seconds(1));
  const UncertainMotion longer = unwatched_step(noise, T, std::chrono::seconds(10));
  EXPECT_EQ(brief.T_from_to.x_m(), T.x_m());
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT(brief.covariance(i, i), watched.covariance(i, i));
    EXPECT_GT(longer.covariance(i, i), brief.covariance(i, i));
  }
  // Standing still for ten seconds unseen is possible; having been somewhere meanwhile, too.
  EXPECT_GT(unwatched_step(noise, Pose2(), std::chrono::seconds(10)).covariance(0, 0), 0.0);
}

TEST(UncertainMotion, ComposesInAnyGrouping) {
  test::RandomGeometry random(1);
  for (int i = 0; i < 100; ++i) {
    const UncertainMotion a = uncertain_step(OdometryNoise(), random.pose());
    const UncertainMotion b = uncertain_step(OdometryNoise(), random.pose());
    const UncertainMotion c = uncertain_step(OdometryNoise(), random.pose());
    EXPECT_TRUE(((a * b) * c).covariance.isApprox((a * (b * c)).covariance, 1e-9));
  }
}

TEST(UncertainMotion, PropagatesWhatManyNoisyDrivesShow) {
  const Pose2 step(0.1, 0.02, 0.05);
  const UncertainMotion uncertain = uncertain_step(OdometryNoise(), step);
  constexpr int kSteps = 15;
  constexpr int kDrives = 4000;
  UncertainMotion predicted = uncertain;
  for (int k = 1; k < kSteps; ++k) predicted = predicted * uncertain;
  test::RandomGeometry random(2);
  const double sigma_xy = std::sqrt(uncertain.covariance(0, 0));
  const double sigma_yaw = std::sqrt(uncertain.covariance(2, 2));
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int drive = 0; drive < kDrives; ++drive) {
    Pose2 end;
    for (int k = 0; k < kSteps; ++k)
      end = end * Pose2(step.x_m() + random.normal(sigma_xy), step.y_m() + random.normal(sigma_xy),
                        step.yaw_rad() + random.normal(sigma_yaw));
    const Eigen::Vector3d error = end.vector() - predicted.T_from_to.vector();
    sum += error * error.transpose() / kDrives;
  }
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum(i, i) / predicted.covariance(i, i), 1.0, 0.1);
  EXPECT_NEAR(sum(1, 2) / predicted.covariance(1, 2), 1.0, 0.15);
}

}  // namespace
}  // namespace swiftlet

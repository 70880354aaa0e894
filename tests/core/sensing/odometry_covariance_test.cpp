// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/odometry_covariance.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "core/geometry/squared.hpp"
#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

constexpr Duration kInterval = std::chrono::milliseconds(100);

TEST(UncertainStep, HasNoErrorWhenTheVehicleStandsStill) {
  EXPECT_TRUE(uncertain_step(OdometryNoise(), Pose2(), kInterval).covariance.isZero(0.0));
}

TEST(UncertainStep, GrowsWithDistanceAndTurnAsTheModelSays) {
  const OdometryNoise noise;
  const UncertainMotion step = uncertain_step(noise, Pose2(0.3, -0.4, -0.2), kInterval);
  const double xy_m2 = 0.5 * squared(noise.xy_m.after_metre) + 0.2 * squared(noise.xy_m.after_radian) +
                       0.1 * squared(noise.xy_m.after_second);
  const double yaw_rad2 = 0.5 * squared(noise.yaw_rad.after_metre) +
                          0.2 * squared(noise.yaw_rad.after_radian) +
                          0.1 * squared(noise.yaw_rad.after_second);
  EXPECT_NEAR(step.covariance(0, 0), xy_m2, 1e-12);
  EXPECT_NEAR(step.covariance(1, 1), xy_m2, 1e-12);
  EXPECT_NEAR(step.covariance(2, 2), yaw_rad2, 1e-12);
  EXPECT_EQ(step.covariance(0, 2), 0.0);
}

/// Some robots report ten times a second, others once: their dead reckoning is as good.
TEST(UncertainStep, IsAsUncertainInHoweverManyStepsItIsMade) {
  const OdometryNoise noise;
  const UncertainMotion whole = uncertain_step(noise, Pose2(0.4, 0.0, 0.0), 8 * kInterval);
  UncertainMotion in_parts;
  for (int i = 0; i < 8; ++i) in_parts = in_parts * uncertain_step(noise, Pose2(0.05, 0.0, 0.0), kInterval);
  EXPECT_NEAR(in_parts.covariance(0, 0), whole.covariance(0, 0), 1e-12);
  EXPECT_NEAR(in_parts.covariance(2, 2), whole.covariance(2, 2), 1e-12);
  EXPECT_GT(in_parts.covariance(1, 1), whole.covariance(1, 1)) << "the heading errs on the way";
}

TEST(UnwatchedStep, IsMoreUncertainTheLongerNobodyWatched) {
  const OdometryNoise noise = SensorModel::crazyflie().odometry;
  const Pose2 T(0.3, 0.1, 0.2);
  const UncertainMotion watched = uncertain_step(noise, T, kInterval);
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
    const UncertainMotion a = uncertain_step(OdometryNoise(), random.pose(), kInterval);
    const UncertainMotion b = uncertain_step(OdometryNoise(), random.pose(), kInterval);
    const UncertainMotion c = uncertain_step(OdometryNoise(), random.pose(), kInterval);
    EXPECT_TRUE(((a * b) * c).covariance.isApprox((a * (b * c)).covariance, 1e-9));
  }
}

TEST(UncertainMotion, PropagatesWhatManyNoisyDrivesShow) {
  const Pose2 step(0.1, 0.02, 0.05);
  const UncertainMotion uncertain = uncertain_step(OdometryNoise(), step, kInterval);
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

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/systematic_prior.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

constexpr Eigen::Index kAge = index_of(SystematicError::kRangeAge);
constexpr Eigen::Index kForward = index_of(SystematicError::kForwardScale);
constexpr Eigen::Index kSideways = index_of(SystematicError::kSidewaysScale);
constexpr Eigen::Index kYawPerMetre = index_of(SystematicError::kYawPerMetre);
constexpr Eigen::Index kYawPerRadian = index_of(SystematicError::kYawPerRadian);
constexpr Eigen::Index kYawPerSecond = index_of(SystematicError::kYawPerSecond);

JointEstimate measured(double sigma) {
  JointEstimate estimate;
  estimate.errors << 0.05, -0.08, -0.06, 0.01, 0.01, 0.001;
  estimate.sigma.setConstant(sigma);
  return estimate;
}

JointEstimate weighed_by(const SensorModel& sensor, const JointEstimate& estimate) {
  return weighed(estimate, sensor, systematic_prior(sensor.odometry));
}

TEST(SystematicPrior, LeavesWhatIsWellKnownAsItWasMeasured) {
  const JointEstimate sure = measured(1e-6);
  const JointEstimate weighed_one = weighed_by(SensorModel::crazyflie(), sure);
  for (const Eigen::Index k : {kAge, kForward, kSideways})
    EXPECT_NEAR(weighed_one.errors(k), sure.errors(k), 1e-4);
  EXPECT_LT(weighed_one.sigma.maxCoeff(), 1e-5);
}

TEST(SystematicPrior, LeavesWhatIsUnknownAtItsPrior) {
  const SystematicPrior prior;
  const JointEstimate unsure = weighed_by(SensorModel::crazyflie(), measured(100.0));
  EXPECT_LT(unsure.errors.cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_NEAR(unsure.sigma(kAge), prior.range_age_s, 1e-4);
}

TEST(SystematicPrior, AScaleShowsTheOther) {
  JointEstimate forward_only = measured(1e-3);
  forward_only.sigma(kSideways) = 1.0;
  forward_only.errors(kSideways) = 0.3;
  EXPECT_NEAR(weighed_by(SensorModel::crazyflie(), forward_only).errors(kSideways), -0.07, 0.01);
}

TEST(SystematicPrior, WheelsDoNotMoveSidewaysAndMissNoYawWithTime) {
  const SystematicErrors errors = weighed_by(SensorModel::carmen_laser(), measured(1e-6)).errors;
  EXPECT_NEAR(errors(kForward), -0.08, 1e-3);
  EXPECT_NEAR(errors(kYawPerMetre), 0.01, 1e-3);
  EXPECT_NEAR(errors(kYawPerRadian), 0.01, 1e-3);
  EXPECT_EQ(errors(kSideways), 0.0);
  EXPECT_EQ(errors(kYawPerSecond), 0.0);
}

TEST(SystematicPrior, TheYawThatWheelsMissIsWhereTheFrontendBegins) {
  SensorModel expected = SensorModel::carmen_laser();
  expected.odometry_calibration.yaw_per_metre_rad = 0.002;
  const SensorModel found = calibrated_by(weighed_by(expected, measured(1e-6)), expected).found;
  EXPECT_NEAR(found.odometry.expected_drift_yaw_per_metre_rad, 0.008, 1e-6);
  EXPECT_NEAR(found.odometry.expected_drift_yaw_per_radian, 0.01, 1e-6);
  EXPECT_DOUBLE_EQ(found.odometry_calibration.yaw_per_metre_rad, 0.002);
  EXPECT_DOUBLE_EQ(found.odometry_calibration.yaw_per_radian, 0.0);
  EXPECT_NEAR(value_in(found, SystematicError::kYawPerMetre), 0.01, 1e-6);
}

TEST(SystematicPrior, DeadReckoningOfWheelsAsAMapStaysAsReported) {
  SensorModel expected = SensorModel::carmen_laser();
  expected.odometry_calibration.forward_scale = 1.02;
  const SensorModel found = calibrated_by(weighed_by(expected, measured(1e-6)), expected).found;
  EXPECT_NEAR(found.odometry_calibration.forward_scale, 0.92, 1e-3);
  EXPECT_DOUBLE_EQ(found.calibration_as_reported().forward_scale, 1.02);
}

TEST(SystematicPrior, DeadReckoningOfAFlowSensorAsAMapHasTheScaleThatWasFound) {
  const SensorModel found = calibrated_by(measured(0.001), SensorModel::crazyflie()).found;
  EXPECT_DOUBLE_EQ(found.calibration_as_reported().forward_scale, 0.92);
}

TEST(SystematicPrior, ARunThatShowsNothingLeavesTheCalibrationOfWheels) {
  SensorModel expected = SensorModel::carmen_laser();
  expected.odometry_calibration.yaw_per_metre_rad = 0.02;
  expected.odometry_calibration.yaw_per_radian = -0.01;
  const SensorModel found = calibrated_by(weighed_by(expected, measured(100.0)), expected).found;
  EXPECT_NEAR(value_in(found, SystematicError::kYawPerMetre), 0.02, 1e-6);
  EXPECT_NEAR(value_in(found, SystematicError::kYawPerRadian), -0.01, 1e-6);
}

TEST(SystematicPrior, TheYawThatAGyroMissesIsTakenOut) {
  const SensorModel found = calibrated_by(measured(0.001), SensorModel::crazyflie()).found;
  EXPECT_DOUBLE_EQ(found.odometry_calibration.yaw_per_radian, 0.01);
  EXPECT_DOUBLE_EQ(found.odometry_calibration.yaw_per_second_rad, 0.001);
  EXPECT_DOUBLE_EQ(found.odometry.expected_drift_yaw_per_radian, 0.0);
}

TEST(SystematicPrior, RangesMayBeNewerThanTheDeadReckoningBesideThemWithinALimit) {
  JointEstimate estimate = measured(0.01);
  estimate.errors(kAge) = -0.2;
  EXPECT_EQ(calibrated_by(estimate, SensorModel::crazyflie()).found.range_age,
            std::chrono::milliseconds(-100));
  estimate.errors(kAge) = -2.0;
  const InputCalibration calibration = calibrated_by(estimate, SensorModel::crazyflie());
  EXPECT_EQ(calibration.found.range_age, kMinRangeAge);
  EXPECT_EQ(calibration.expected.range_age, SensorModel::crazyflie().range_age);
  EXPECT_DOUBLE_EQ(calibration.found.odometry_calibration.forward_scale, 0.92);
}

}  // namespace
}  // namespace swiftlet

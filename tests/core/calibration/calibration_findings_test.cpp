// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/calibration_findings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swiftlet {
namespace {

using testing::HasSubstr;
using Verdict = CalibrationFinding::Verdict;

MotionSummary long_flight() { return {400.0, 200.0, 50.0, 90.0}; }

/// All known well and without error.
JointEstimate sharp_estimate() {
  JointEstimate estimate;
  estimate.sigma << 0.003, 0.003, 0.003, radians(0.05), 0.003, radians(0.01);
  estimate.returns_on_them = 5000;
  return estimate;
}

const CalibrationFinding& of(const CalibrationFindings& findings, SystematicError error) {
  return findings[static_cast<std::size_t>(error)];
}

TEST(CalibrationFindings, TellWhatIsAsItWas) {
  const CalibrationFindings findings =
      judge_estimate(sharp_estimate(), long_flight(), SensorModel::crazyflie());
  const CalibrationFinding& age = of(findings, SystematicError::kRangeAge);
  EXPECT_EQ(age.verdict, Verdict::kAsIs);
  EXPECT_EQ(age.setting, "range_age_s");
  EXPECT_NEAR(age.value, 0.1, 1e-12);
  EXPECT_NEAR(age.present, 0.1, 1e-12);
  EXPECT_NEAR(of(findings, SystematicError::kForwardScale).value, 1.0, 1e-12);
}

TEST(CalibrationFindings, TellWhatMattersFromWhatIsTooLittle) {
  JointEstimate estimate = sharp_estimate();
  estimate.errors(index_of(SystematicError::kRangeAge)) = 0.02;
  estimate.errors(index_of(SystematicError::kForwardScale)) = 0.0045;
  estimate.sigma(index_of(SystematicError::kForwardScale)) = 0.001;
  const CalibrationFindings findings = judge_estimate(estimate, long_flight(), SensorModel::crazyflie());
  EXPECT_EQ(of(findings, SystematicError::kRangeAge).verdict, Verdict::kMatters);
  EXPECT_EQ(of(findings, SystematicError::kForwardScale).verdict, Verdict::kNegligible);
  const SensorModel sensor = calibrated(findings, SensorModel::crazyflie());
  EXPECT_NEAR(to_seconds(sensor.range_age), 0.12, 1e-9);
  EXPECT_EQ(sensor.odometry_calibration.forward_scale, 1.0);
}

TEST(CalibrationFindings, AnAgeIsOneThatCanBeSet) {
  JointEstimate estimate = sharp_estimate();
  estimate.errors(index_of(SystematicError::kRangeAge)) = -0.5;
  const CalibrationFindings findings = judge_estimate(estimate, long_flight(), SensorModel::crazyflie());
  EXPECT_EQ(calibrated(findings, SensorModel::crazyflie()).range_age, kMinRangeAge);
}

TEST(CalibrationFindings, AnUncertainFigureIsNone) {
  JointEstimate estimate = sharp_estimate();
  estimate.sigma(index_of(SystematicError::kSidewaysScale)) = 0.2;
  const CalibrationFindings findings = judge_estimate(estimate, long_flight(), SensorModel::crazyflie());
  EXPECT_EQ(of(findings, SystematicError::kSidewaysScale).verdict, Verdict::kNotObservable);
  EXPECT_THAT(of(findings, SystematicError::kSidewaysScale).reason, HasSubstr("+- 0.2 only"));
}

TEST(CalibrationFindings, SayWhichMotionIsMissing) {
  const CalibrationFindings findings =
      judge_estimate(sharp_estimate(), {30.0, 200.0, 2.0, 1.0}, SensorModel::crazyflie());
  EXPECT_THAT(of(findings, SystematicError::kRangeAge).reason, HasSubstr("turns"));
  EXPECT_THAT(of(findings, SystematicError::kYawPerRadian).reason, HasSubstr("turns"));
  EXPECT_THAT(of(findings, SystematicError::kSidewaysScale).reason, HasSubstr("sideways"));
  EXPECT_THAT(of(findings, SystematicError::kYawPerSecond).reason, HasSubstr("only 30 s long"));
  EXPECT_THAT(of(findings, SystematicError::kYawPerMetre).reason, HasSubstr("gyro"));
  EXPECT_EQ(of(findings, SystematicError::kForwardScale).verdict, Verdict::kAsIs);
}

TEST(CalibrationFindings, WhatTheFrontendLearnsOfWheelsIsLeftToIt) {
  JointEstimate estimate = sharp_estimate();
  estimate.errors(index_of(SystematicError::kYawPerMetre)) = radians(2.0);
  const CalibrationFindings findings = judge_estimate(estimate, long_flight(), SensorModel::carmen_laser());
  EXPECT_EQ(of(findings, SystematicError::kYawPerMetre).verdict, Verdict::kLearnt);
  EXPECT_EQ(calibrated(findings, SensorModel::carmen_laser()).odometry_calibration.yaw_per_metre_rad, 0.0);
  EXPECT_EQ(of(findings, SystematicError::kSidewaysScale).verdict, Verdict::kNotObservable);
  EXPECT_EQ(of(findings, SystematicError::kYawPerSecond).verdict, Verdict::kNotObservable);
}

TEST(CalibrationFindings, WithoutWallsNothingIsObservable) {
  JointEstimate estimate = sharp_estimate();
  estimate.returns_on_them = 20;
  const CalibrationFindings findings = judge_estimate(estimate, long_flight(), SensorModel::crazyflie());
  ASSERT_FALSE(findings.empty());
  for (const CalibrationFinding& finding : findings) {
    EXPECT_EQ(finding.verdict, Verdict::kNotObservable) << finding.setting;
    EXPECT_THAT(finding.reason, HasSubstr("only 20 returns"));
  }
}

TEST(CalibrationFindings, AVehicleThatStoodTellsNothing) {
  EXPECT_FALSE(why_hopeless(long_flight()));
  const auto reason = why_hopeless({300.0, 0.4, 0.2, 0.1});
  ASSERT_TRUE(reason);
  EXPECT_THAT(*reason, HasSubstr("moved only 0.6 m"));
}

}  // namespace
}  // namespace swiftlet

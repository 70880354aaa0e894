// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/systematic_prior.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

constexpr Eigen::Index kAge = index_of(SystematicError::kRangeAge);
constexpr Eigen::Index kForward = index_of(SystematicError::kForwardScale);
constexpr Eigen::Index kSideways = index_of(SystematicError::kSidewaysScale);

JointEstimate measured(double sigma) {
  JointEstimate estimate;
  estimate.errors << 0.05, -0.08, -0.06, 0.01, 0.01, 0.001;
  estimate.sigma.setConstant(sigma);
  return estimate;
}

TEST(SystematicPrior, LeavesWhatIsWellKnownAsItWasMeasured) {
  const JointEstimate sure = measured(1e-6);
  const JointEstimate weighed_one = weighed(sure, SensorModel::crazyflie());
  for (const Eigen::Index k : {kAge, kForward, kSideways})
    EXPECT_NEAR(weighed_one.errors(k), sure.errors(k), 1e-4);
  EXPECT_LT(weighed_one.sigma.maxCoeff(), 1e-5);
}

TEST(SystematicPrior, LeavesWhatIsUnknownAtItsPrior) {
  const SystematicPrior prior;
  const JointEstimate unsure = weighed(measured(100.0), SensorModel::crazyflie());
  EXPECT_LT(unsure.errors.cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_NEAR(unsure.sigma(kAge), prior.range_age_s, 1e-4);
}

TEST(SystematicPrior, AScaleShowsTheOther) {
  JointEstimate forward_only = measured(1e-3);
  forward_only.sigma(kSideways) = 1.0;
  forward_only.errors(kSideways) = 0.3;
  EXPECT_NEAR(weighed(forward_only, SensorModel::crazyflie()).errors(kSideways), -0.07, 0.01);
}

TEST(SystematicPrior, WheelsDoNotMoveSidewaysAndTheirYawIsLearntInTheRun) {
  const SystematicErrors errors = weighed(measured(1e-6), SensorModel::carmen_laser()).errors;
  EXPECT_NEAR(errors(kForward), -0.08, 1e-3);
  EXPECT_EQ(errors.tail<4>(), Eigen::Vector4d::Zero());
}

TEST(SystematicPrior, AnAgeIsNotNegative) {
  JointEstimate estimate = measured(0.01);
  estimate.errors(kAge) = -0.2;
  const InputCalibration calibration = calibrated_by(estimate, SensorModel::crazyflie());
  EXPECT_EQ(calibration.found.range_age, Duration::zero());
  EXPECT_EQ(calibration.expected.range_age, SensorModel::crazyflie().range_age);
  EXPECT_DOUBLE_EQ(calibration.found.odometry_calibration.forward_scale, 0.92);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/odometry_calibration.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace swiftlet {
namespace {

constexpr Duration kElapsed = std::chrono::milliseconds(500);

TEST(OdometryCalibration, ChangesNothingByDefault) {
  const Pose2 measured(0.3, -0.1, 0.2);
  EXPECT_EQ(OdometryCalibration().corrected(measured, kElapsed).vector(), measured.vector());
}

TEST(OdometryCalibration, ScalesWhatWasMoved) {
  const OdometryCalibration calibration{.forward_scale = 1.1, .sideways_scale = 0.9};
  const Pose2 corrected = calibration.corrected(Pose2(2.0, 1.0, 0.5), kElapsed);
  EXPECT_NEAR(corrected.x_m(), 2.2, 1e-12);
  EXPECT_NEAR(corrected.y_m(), 0.9, 1e-12);
  EXPECT_NEAR(corrected.yaw_rad(), 0.5, 1e-12);
}

TEST(OdometryCalibration, AddsTheYawThatIsMissed) {
  const OdometryCalibration calibration{
      .yaw_per_metre_rad = 0.01, .yaw_per_radian = 0.02, .yaw_per_second_rad = 0.03};
  EXPECT_NEAR(calibration.corrected(Pose2(2.0, 0.0, 0.5), kElapsed).yaw_rad(), 0.5 + 0.02 + 0.01 + 0.015,
              1e-12);
}

TEST(OdometryCalibration, LeavesAVehicleThatStandsWhereItIs) {
  const OdometryCalibration calibration{.yaw_per_second_rad = 0.1};
  EXPECT_EQ(calibration.corrected(Pose2(), kElapsed).yaw_rad(), 0.0);
}

}  // namespace
}  // namespace swiftlet

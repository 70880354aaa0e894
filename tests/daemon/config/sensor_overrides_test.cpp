// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/config/sensor_overrides.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace swiftlet {
namespace {

TEST(SensorOverrides, TakeACalibrationWhereNothingIsSet) {
  SensorOverrides overrides;
  overrides.range_age_s = 0.15;
  SensorModel found = SensorModel::crazyflie();
  found.range_age = std::chrono::milliseconds(50);
  found.odometry_calibration.forward_scale = 1.05;
  found.reported_forward_scale = 1.01;
  overrides.take_calibration(found);
  EXPECT_EQ(overrides.range_age_s, 0.15);
  EXPECT_EQ(overrides.odometry_forward_scale, 1.05);
  EXPECT_EQ(overrides.reported_forward_scale, 1.01);
}

TEST(SensorOverrides, ReplaceOnlyWhatIsSet) {
  SensorOverrides overrides;
  overrides.range_sigma_m = 0.07;
  overrides.max_range_m = 10.0;
  overrides.range_age_s = 0.02;
  overrides.odometry_forward_scale = 0.95;
  overrides.odometry_sideways_scale = 1.05;
  overrides.missed_yaw_per_metre_rad = 0.01;
  overrides.missed_yaw_per_radian = 0.02;
  overrides.missed_yaw_per_second_rad = 0.03;
  const SensorModel model = overrides.applied_to(SensorModel::crazyflie());
  EXPECT_EQ(model.range_sigma_m, 0.07);
  EXPECT_EQ(model.range_age, std::chrono::milliseconds(20));
  EXPECT_EQ(model.odometry_calibration.forward_scale, 0.95);
  EXPECT_EQ(model.odometry_calibration.sideways_scale, 1.05);
  EXPECT_EQ(model.odometry_calibration.yaw_per_metre_rad, 0.01);
  EXPECT_EQ(model.odometry_calibration.yaw_per_radian, 0.02);
  EXPECT_EQ(model.odometry_calibration.yaw_per_second_rad, 0.03);
  EXPECT_EQ(model.calibration_as_reported().forward_scale, 0.95);
  EXPECT_EQ(model.max_range_m, SensorModel::crazyflie().max_range_m) << "the input's own";
}

TEST(SensorOverrides, DeadReckoningAsAMapMayHaveAScaleOfItsOwn) {
  SensorOverrides overrides;
  overrides.odometry_forward_scale = 0.95;
  overrides.reported_forward_scale = 1.03;
  const SensorModel model = overrides.applied_to(SensorModel::crazyflie());
  EXPECT_EQ(model.odometry_calibration.forward_scale, 0.95);
  EXPECT_EQ(model.calibration_as_reported().forward_scale, 1.03);
}

}  // namespace
}  // namespace swiftlet

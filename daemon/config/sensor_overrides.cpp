// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/config/sensor_overrides.hpp"

namespace swiftlet {

std::vector<std::string> SensorOverrides::validate() const {
  std::vector<std::string> problems = setting_problems(*this);
  if (problems.empty() && min_range_m && max_range_m && *min_range_m >= *max_range_m)
    problems.emplace_back("sensor.min_range_m must be less than sensor.max_range_m");
  return problems;
}

void SensorOverrides::take_calibration(const SensorModel& calibrated) {
  const OdometryCalibration& calibration = calibrated.odometry_calibration;
  const auto take = [](double value, std::optional<double>& setting) { setting = setting.value_or(value); };
  take(to_seconds(calibrated.range_age), range_age_s);
  take(calibration.forward_scale, odometry_forward_scale);
  if (calibrated.reported_forward_scale) take(*calibrated.reported_forward_scale, reported_forward_scale);
  take(calibration.sideways_scale, odometry_sideways_scale);
  take(calibration.yaw_per_metre_rad, missed_yaw_per_metre_rad);
  take(calibration.yaw_per_radian, missed_yaw_per_radian);
  take(calibration.yaw_per_second_rad, missed_yaw_per_second_rad);
  take(calibrated.odometry.expected_drift_yaw_per_metre_rad, expected_drift_yaw_per_metre_rad);
  take(calibrated.odometry.expected_drift_yaw_per_radian, expected_drift_yaw_per_radian);
}

SensorModel SensorOverrides::applied_to(SensorModel model) const {
  model.range_sigma_m = range_sigma_m.value_or(model.range_sigma_m);
  if (range_age_s) model.range_age = from_seconds(*range_age_s);
  model.odometry.xy_m.after_metre = odometry_xy_after_metre_m.value_or(model.odometry.xy_m.after_metre);
  model.odometry.yaw_rad.after_radian =
      odometry_yaw_after_radian_rad.value_or(model.odometry.yaw_rad.after_radian);
  model.odometry.yaw_rad.after_metre =
      odometry_yaw_after_metre_rad.value_or(model.odometry.yaw_rad.after_metre);
  model.odometry.drift_yaw_per_metre_rad =
      drift_yaw_per_metre_rad.value_or(model.odometry.drift_yaw_per_metre_rad);
  model.odometry.drift_yaw_per_radian = drift_yaw_per_radian.value_or(model.odometry.drift_yaw_per_radian);
  model.odometry.expected_drift_yaw_per_metre_rad =
      expected_drift_yaw_per_metre_rad.value_or(model.odometry.expected_drift_yaw_per_metre_rad);
  model.odometry.expected_drift_yaw_per_radian =
      expected_drift_yaw_per_radian.value_or(model.odometry.expected_drift_yaw_per_radian);
  OdometryCalibration& calibration = model.odometry_calibration;
  calibration.forward_scale = odometry_forward_scale.value_or(calibration.forward_scale);
  if (reported_forward_scale) model.reported_forward_scale = reported_forward_scale;
  calibration.sideways_scale = odometry_sideways_scale.value_or(calibration.sideways_scale);
  calibration.yaw_per_metre_rad = missed_yaw_per_metre_rad.value_or(calibration.yaw_per_metre_rad);
  calibration.yaw_per_radian = missed_yaw_per_radian.value_or(calibration.yaw_per_radian);
  calibration.yaw_per_second_rad = missed_yaw_per_second_rad.value_or(calibration.yaw_per_second_rad);
  return model;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/config/configuration.hpp"

#include <algorithm>
#include <cstddef>

#include "daemon/config/configuration_fields.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kMaxPrefix = 40;  // LCM allows 63 characters for a whole channel name

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

bool is_channel_name(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.' || c == '/';
  });
}

}  // namespace

SensorModel SensorOverrides::applied_to(SensorModel model) const {
  model.min_range_m = min_range_m.value_or(model.min_range_m);
  model.max_range_m = max_range_m.value_or(model.max_range_m);
  model.range_sigma_m = range_sigma_m.value_or(model.range_sigma_m);
  if (range_age_s) model.range_age = from_seconds(*range_age_s);
  model.odometry.xy_per_metre = odometry_xy_per_metre.value_or(model.odometry.xy_per_metre);
  model.odometry.yaw_per_radian = odometry_yaw_per_radian.value_or(model.odometry.yaw_per_radian);
  model.odometry.yaw_per_metre_rad = odometry_yaw_per_metre_rad.value_or(model.odometry.yaw_per_metre_rad);
  model.odometry.drift_yaw_per_metre_rad =
      drift_yaw_per_metre_rad.value_or(model.odometry.drift_yaw_per_metre_rad);
  model.odometry.drift_yaw_per_radian = drift_yaw_per_radian.value_or(model.odometry.drift_yaw_per_radian);
  OdometryCalibration& calibration = model.odometry_calibration;
  calibration.forward_scale = odometry_forward_scale.value_or(calibration.forward_scale);
  calibration.sideways_scale = odometry_sideways_scale.value_or(calibration.sideways_scale);
  calibration.yaw_per_metre_rad = missed_yaw_per_metre_rad.value_or(calibration.yaw_per_metre_rad);
  calibration.yaw_per_radian = missed_yaw_per_radian.value_or(calibration.yaw_per_radian);
  calibration.yaw_per_second_rad = missed_yaw_per_second_rad.value_or(calibration.yaw_per_second_rad);
  return model;
}

std::vector<std::string> Configuration::validate() const {
  std::vector<std::string> problems;
  Configuration copy = *this;  // the table points at fields that may be written
  for (const ConfigurationField& field : configuration_fields()) {
    if (std::string problem = field_problem(field, copy); !problem.empty()) problems.push_back(problem);
  }
  if (publish.channel_prefix.size() > kMaxPrefix || !is_channel_name(publish.channel_prefix))
    problems.push_back("publish.channel_prefix = \"" + publish.channel_prefix +
                       "\": at most 40 letters, digits and _ - . /");
  if (!problems.empty()) return problems;  // how fields agree is asked when each makes sense by itself
  if (sensor.min_range_m && sensor.max_range_m && *sensor.min_range_m >= *sensor.max_range_m)
    problems.emplace_back("sensor.min_range_m must be less than sensor.max_range_m");
  if (record.max_total_mb < record.max_file_mb)
    problems.emplace_back("record.max_total_mb must not be less than record.max_file_mb");
  append(problems, frontend.validate());
  append(problems, backend.validate());
  append(problems, map.validate());
  return problems;
}

}  // namespace swiftlet

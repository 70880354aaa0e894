// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// What a configuration file may set of the sensor; what it leaves out comes from the input's own kind.
struct SensorOverrides {
  std::optional<double> min_range_m;
  std::optional<double> max_range_m;
  std::optional<double> range_sigma_m;
  std::optional<double> range_age_s;
  std::optional<double> odometry_xy_after_metre_m;
  std::optional<double> odometry_yaw_after_radian_rad;
  std::optional<double> odometry_yaw_after_metre_rad;
  std::optional<double> drift_yaw_per_metre_rad;
  std::optional<double> drift_yaw_per_radian;
  std::optional<double> expected_drift_yaw_per_metre_rad;
  std::optional<double> expected_drift_yaw_per_radian;
  std::optional<double> odometry_forward_scale;
  std::optional<double> reported_forward_scale;
  std::optional<double> odometry_sideways_scale;
  std::optional<double> missed_yaw_per_metre_rad;
  std::optional<double> missed_yaw_per_radian;
  std::optional<double> missed_yaw_per_second_rad;

  static constexpr SettingsSection kSection{
      "sensor", "What is left out comes from the kind of input: Crazyflie or laser log."};
  static constexpr Setting<SensorOverrides> kSettings[] = {
      {"min_range_m", &SensorOverrides::min_range_m, "m",
       "shorter readings are invalid; less than max_range_m", 0, 10},
      {"max_range_m", &SensorOverrides::max_range_m, "m", "longer readings count as no return", 0.1, 100},
      {"range_sigma_m", &SensorOverrides::range_sigma_m, "m",
       "standard deviation of a reading, along the beam", 0.0001, 1},
      {"range_age_s", &SensorOverrides::range_age_s, "s",
       "how much older the ranges of a packet are than its stamp; negative: newer", to_seconds(kMinRangeAge),
       to_seconds(kMaxRangeAge)},
      {"odometry_xy_after_metre_m", &SensorOverrides::odometry_xy_after_metre_m, "m",
       "standard deviation of the position after a metre travelled; it grows with the root of the way", 0, 1},
      {"odometry_yaw_after_radian_rad", &SensorOverrides::odometry_yaw_after_radian_rad, "rad",
       "standard deviation of the heading after a radian turned; likewise", 0, 1},
      {"odometry_yaw_after_metre_rad", &SensorOverrides::odometry_yaw_after_metre_rad, "rad",
       "standard deviation of the heading after a metre travelled; likewise", 0, 1},
      {"drift_yaw_per_metre_rad", &SensorOverrides::drift_yaw_per_metre_rad, "rad/m",
       "standard deviation of the yaw that dead reckoning misses with every metre; 0: none is learnt", 0, 1},
      {"drift_yaw_per_radian", &SensorOverrides::drift_yaw_per_radian, "rad/rad",
       "the same with every radian turned", 0, 1},
      {"expected_drift_yaw_per_metre_rad", &SensorOverrides::expected_drift_yaw_per_metre_rad, "rad/m",
       "the yaw missed with every metre forward at which learning begins; swiftlet map estimates it", -0.5,
       0.5},
      {"expected_drift_yaw_per_radian", &SensorOverrides::expected_drift_yaw_per_radian, "rad/rad",
       "the same with every radian turned", -0.5, 0.5},
      {"odometry_forward_scale", &SensorOverrides::odometry_forward_scale, "m/m",
       "metres moved per metre of dead reckoning, forward; swiftlet calibrate estimates this, "
       "odometry_sideways_scale, the missed_yaw_ keys and range_age_s",
       0.5, 2},
      {"reported_forward_scale", &SensorOverrides::reported_forward_scale, "m/m",
       "the forward scale where the final map follows dead reckoning alone; left out: "
       "odometry_forward_scale (for wheels as configured, not as swiftlet map estimates it)",
       0.5, 2},
      {"odometry_sideways_scale", &SensorOverrides::odometry_sideways_scale, "m/m",
       "metres moved per metre of dead reckoning, sideways", 0.5, 2},
      {"missed_yaw_per_metre_rad", &SensorOverrides::missed_yaw_per_metre_rad, "rad/m",
       "yaw that dead reckoning misses with every metre forward", -0.5, 0.5},
      {"missed_yaw_per_radian", &SensorOverrides::missed_yaw_per_radian, "rad/rad",
       "the same with every radian turned", -0.5, 0.5},
      {"missed_yaw_per_second_rad", &SensorOverrides::missed_yaw_per_second_rad, "rad/s",
       "the same with every second in motion", -0.1, 0.1},
  };

  /// All that is wrong with it, one line each; empty when usable.
  [[nodiscard]] std::vector<std::string> validate() const;

  /// Takes the systematic errors of a calibrated model, age of the ranges, scales, missed yaw and drift,
  /// where none is set.
  void take_calibration(const SensorModel& calibrated);

  /// The input's model with what is set here put in its place; the limits of the ranges stay as they are: the
  /// input has taken those that are set here, or has narrower ones of its own.
  [[nodiscard]] SensorModel applied_to(SensorModel model) const;
};

}  // namespace swiftlet

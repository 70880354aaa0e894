// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "core/base/time.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensing/odometry_calibration.hpp"
#include "core/sensing/range_sample.hpp"

namespace swiftlet {

/// Where the beams of a sensor point. Fixed for a whole run.
struct BeamLayout {
  std::uint8_t count = 0;
  std::array<double, kMaxBeams> bearing_rad{};  ///< in the body frame, counter-clockwise from x forward

  /// Multiranger deck, in the order front, left, back, right.
  static BeamLayout multiranger() { return {4, {0.0, kPi / 2.0, kPi, -kPi / 2.0}}; }
};

/// Errors that add up independently: their variance grows with way, turn and time, in however many steps a
/// motion is measured. Standard deviations after a metre, a radian and a second.
struct RandomWalk {
  double after_metre = 0.0;
  double after_radian = 0.0;
  double after_second = 0.0;

  [[nodiscard]] double variance(double way_m, double turn_rad, double seconds) const {
    return after_metre * after_metre * way_m + after_radian * after_radian * turn_rad +
           after_second * after_second * seconds;
  }
  [[nodiscard]] RandomWalk scaled(double factor) const {
    return {factor * after_metre, factor * after_radian, factor * after_second};
  }
};

/// Errors of dead reckoning: a random walk of position and yaw, and errors that persist over the whole run,
/// which the frontend estimates and removes (none where 0).
struct OdometryNoise {
  RandomWalk xy_m{0.02, 0.02, 0.005};
  RandomWalk yaw_rad{radians(0.4), radians(1.3), radians(0.1)};
  double steps_err_together = 1.0;  ///< so many steps in a row share their error: a sum over single steps
                                    ///< gives each that much less weight
  double drift_yaw_per_metre_rad =
      0.0;  ///< standard deviation of the yaw that is missed with each metre forward
  double drift_yaw_per_radian = 0.0;              ///< ... and with each radian turned
  double expected_drift_yaw_per_metre_rad = 0.0;  ///< the mean of that yaw: where the estimate begins
  double expected_drift_yaw_per_radian = 0.0;
  double detour_speed_m_per_s = 0.5;        ///< how fast the vehicle may move while no packet arrives ...
  double detour_turn_rate_rad_per_s = 0.5;  ///< ... and turn
};

/// Ranges that are older than this when their packet is stamped are no sensor's. They may be newer than the
/// dead reckoning beside them, which an estimator delays.
inline constexpr Duration kMaxRangeAge = std::chrono::seconds(1);
inline constexpr Duration kMinRangeAge = std::chrono::milliseconds(-250);
constexpr Duration within_limits_of_range_age(Duration age) {
  return std::clamp(age, kMinRangeAge, kMaxRangeAge);
}

/// All that depends on the sensor and its vehicle; the algorithm's settings are the same for all of them.
struct SensorModel {
  double min_range_m = 0.05;    ///< shorter readings are invalid
  double max_range_m = 3.0;     ///< longer readings count as no return
  double range_sigma_m = 0.02;  ///< standard deviation of a reading, along the beam
  Duration range_age{0};        ///< how much older the ranges of a packet are than its stamp; may be negative
  OdometryNoise odometry;
  OdometryCalibration odometry_calibration;  ///< applied to each measured motion first
  /// Its forward scale where dead reckoning is a map of its own; nothing: the same.
  std::optional<double> reported_forward_scale;

  /// For dead reckoning as a map of its own.
  [[nodiscard]] OdometryCalibration calibration_as_reported() const {
    OdometryCalibration calibration = odometry_calibration;
    calibration.forward_scale = reported_forward_scale.value_or(calibration.forward_scale);
    return calibration;
  }

  /// Crazyflie with Multiranger and flow deck. Its yaw comes from a gyro: no error of it grows with travel.
  /// Readings are measured about 0.1 s before the packet that carries them.
  static SensorModel crazyflie() {
    SensorModel model;
    model.range_age = std::chrono::milliseconds(100);
    model.odometry.steps_err_together = 4.0;  // the flow sensor's scale changes with the ground below it
    return model;
  }
  /// Laser scanners on wheeled robots as in CARMEN logs, capped at 5 m as in the IROS 2022 paper. Wheels of
  /// two sizes turn a robot by degrees with every metre.
  static SensorModel carmen_laser() {
    SensorModel model;
    model.max_range_m = 5.0;
    model.odometry.xy_m = model.odometry.xy_m.scaled(2.0);
    model.odometry.yaw_rad = model.odometry.yaw_rad.scaled(2.75);
    model.odometry.drift_yaw_per_metre_rad = radians(2.0);
    model.odometry.drift_yaw_per_radian = 0.02;
    return model;
  }
};

}  // namespace swiftlet

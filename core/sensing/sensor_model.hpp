// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

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

/// Errors of dead reckoning. Independent errors of one step, as functions of its length d (m) and turn (rad):
/// sigma_xy = xy_floor + xy_per_metre * d + xy_per_radian * turn,
/// sigma_yaw = yaw_floor + yaw_per_radian * turn + yaw_per_metre * d;
/// and errors that persist over the whole run, which the frontend estimates and removes (none where 0).
struct OdometryNoise {
  double xy_floor_m = 0.002;
  double xy_per_metre = 0.05;
  double xy_per_radian_m = 0.01;
  double yaw_floor_rad = radians(0.05);
  double yaw_per_radian = 0.05;
  double yaw_per_metre_rad = radians(1.0);
  double steps_err_together = 1.0;  ///< so many consecutive steps share their error: a sum over single steps
                                    ///< gives each that much less weight
  double drift_yaw_per_metre_rad =
      0.0;  ///< standard deviation of the yaw that is missed with each metre forward
  double drift_yaw_per_radian = 0.0;              ///< ... and with each radian turned
  double expected_drift_yaw_per_metre_rad = 0.0;  ///< the mean of that yaw: where the estimate begins
  double expected_drift_yaw_per_radian = 0.0;
  double detour_speed_m_per_s = 0.5;        ///< how fast the vehicle may move while no packet arrives ...
  double detour_turn_rate_rad_per_s = 0.5;  ///< ... and turn
};

/// Ranges that are older than this when their packet is stamped are no sensor's.
inline constexpr Duration kMaxRangeAge = std::chrono::seconds(1);

/// All that depends on the sensor and its vehicle; the algorithm's settings are the same for all of them.
struct SensorModel {
  double min_range_m = 0.05;    ///< shorter readings are invalid
  double max_range_m = 3.0;     ///< longer readings count as no return
  double range_sigma_m = 0.02;  ///< standard deviation of a reading, along the beam
  Duration range_age{0};        ///< how much older the ranges of a packet are than its stamp
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
    model.odometry = {.xy_floor_m = 0.004,
                      .xy_per_metre = 0.1,
                      .xy_per_radian_m = 0.02,
                      .yaw_floor_rad = radians(0.1),
                      .yaw_per_radian = 0.1,
                      .yaw_per_metre_rad = radians(2.0),
                      .drift_yaw_per_metre_rad = radians(2.0),
                      .drift_yaw_per_radian = 0.02};
    return model;
  }
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "core/calibration/calibration_scan.hpp"
#include "core/sensing/odometry_calibration.hpp"
#include "core/sensing/range_sample.hpp"

namespace swiftlet {

/// How a flight is made, and what is wrong with its sensors.
struct RoomFlight {
  int scans = 1200;
  double period_s = 0.1;
  double age_s = 0.0;               ///< how much older the ranges are than is assumed
  OdometryCalibration calibration;  ///< what would set its dead reckoning right
  double range_sigma_m = 0.01;
  double step_sigma_m = 0.002;
  double yaw_sigma_rad = 0.0005;
};

/// Where the vehicle is: along a rounded square, swaying and looking about.
inline Pose2 true_pose(double t_s) {
  const double way = 0.12 * t_s;
  return {1.4 * std::cos(way) + 0.15 * std::sin(1.3 * t_s), 1.1 * std::sin(way) + 0.1 * std::cos(0.9 * t_s),
          way + kPi / 2.0 + 0.5 * std::sin(0.7 * t_s)};
}

/// Distance to the walls of a room of 5 x 4 m around the origin.
inline double distance_in_room(const Point2& from, double direction_rad) {
  const double c = std::cos(direction_rad);
  const double s = std::sin(direction_rad);
  const auto along = [](double room, double step) {
    return step == 0.0 ? std::numeric_limits<double>::infinity() : room / step;
  };
  return std::min(along(c > 0 ? 2.5 - from.x_m : -2.5 - from.x_m, c),
                  along(s > 0 ? 2.0 - from.y_m : -2.0 - from.y_m, s));
}

struct FlownScans {
  std::vector<CalibrationScan> scans;
  std::vector<Pose2> T_map_body;  ///< true, at the times that the scans claim
};

/// The measured step of which `corrected` makes the true one.
inline Pose2 as_measured(const OdometryCalibration& calibration, const Pose2& step, double elapsed_s) {
  const double x_m = step.x_m() / calibration.forward_scale;
  return {
      x_m, step.y_m() / calibration.sideways_scale,
      (step.yaw_rad() - calibration.yaw_per_metre_rad * x_m - calibration.yaw_per_second_rad * elapsed_s) /
          (1.0 + calibration.yaw_per_radian)};
}

inline FlownScans fly(const RoomFlight& flight) {
  std::mt19937 random(7);
  const auto noise = [&](double sigma) { return std::normal_distribution<double>(0.0, sigma)(random); };
  FlownScans flown;
  Pose2 T_odom_body;
  for (int i = 0; i < flight.scans; ++i) {
    const double t_s = i * flight.period_s;
    const Pose2 here = true_pose(t_s);
    if (i > 0) {
      const Pose2 step =
          as_measured(flight.calibration, between(flown.T_map_body.back(), here), flight.period_s);
      T_odom_body = T_odom_body * Pose2(step.x_m() + noise(flight.step_sigma_m),
                                        step.y_m() + noise(flight.step_sigma_m),
                                        step.yaw_rad() + noise(flight.yaw_sigma_rad));
    }
    CalibrationScan scan{DeviceTime(from_seconds(t_s)), T_odom_body, i == 0, {}};
    const Pose2 then = true_pose(t_s - flight.age_s);
    for (int beam = 0; beam < 4; ++beam) {
      const double bearing_rad = beam * kPi / 2.0;
      const double distance_m =
          distance_in_room(then.position(), then.yaw_rad() + bearing_rad) + noise(flight.range_sigma_m);
      scan.hits_body.push_back({distance_m * std::cos(bearing_rad), distance_m * std::sin(bearing_rad)});
    }
    flown.scans.push_back(scan);
    flown.T_map_body.push_back(here);
  }
  return flown;
}

/// The same scans as an input delivers them.
inline std::vector<RangeSample> samples_of(const RoomFlight& flight) {
  std::vector<RangeSample> samples;
  for (const CalibrationScan& scan : fly(flight).scans) {
    RangeSample sample;
    sample.sequence = static_cast<std::uint32_t>(samples.size());
    sample.measured_at = scan.measured_at;
    sample.T_odom_body = scan.T_odom_body;
    sample.starts_segment = scan.starts_segment;
    sample.beam_count = 4;
    for (std::size_t beam = 0; beam < 4; ++beam) {
      sample.distance_m[beam] =
          static_cast<float>(std::hypot(scan.hits_body[beam].x_m, scan.hits_body[beam].y_m));
      sample.status[beam] = RangeStatus::kHit;
    }
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace swiftlet

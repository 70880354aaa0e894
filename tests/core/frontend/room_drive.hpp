// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "core/sensing/odometry_covariance.hpp"
#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"
#include "tests/support/random_geometry.hpp"

namespace swiftlet::test {

struct RoomWall {
  Point2 start;
  Point2 end;
};

/// A vehicle driven through line walls: true poses, and the samples it would send.
struct RoomDrive {
  std::vector<Pose2> T_room_body;
  std::vector<RangeSample> samples;
};

struct DriveErrors {
  double odometry_noise_scale = 1.0;     // of SensorModel's
  double yaw_drift_rad_per_metre = 0.0;  // systematic
};

/// A rectangular ring of corridors, 2 m wide, outer size 12 m x 8 m, with its first corner at the origin.
inline std::vector<RoomWall> ring_of_corridors() {
  const auto rectangle = [](double x0, double y0, double x1, double y1) {
    return std::vector<RoomWall>{
        {{x0, y0}, {x1, y0}}, {{x1, y0}, {x1, y1}}, {{x1, y1}, {x0, y1}}, {{x0, y1}, {x0, y0}}};
  };
  std::vector<RoomWall> walls = rectangle(0.0, 0.0, 12.0, 8.0);
  const std::vector<RoomWall> inner = rectangle(2.0, 2.0, 10.0, 6.0);
  walls.insert(walls.end(), inner.begin(), inner.end());
  return walls;
}

/// Distance along the ray to the nearest wall, if any.
inline std::optional<double> cast_ray(const std::vector<RoomWall>& walls, const Pose2& T_room_beam) {
  std::optional<double> nearest;
  const Pose2 T_beam_room = T_room_beam.inverse();
  for (const RoomWall& wall : walls) {
    const Point2 a = T_beam_room * wall.start;
    const Point2 b = T_beam_room * wall.end;
    if ((a.y_m > 0.0) == (b.y_m > 0.0)) continue;
    const double x = a.x_m + (b.x_m - a.x_m) * a.y_m / (a.y_m - b.y_m);
    if (x > 0.0 && (!nearest || x < *nearest)) nearest = x;
  }
  return nearest;
}

inline RangeSample sense(const std::vector<RoomWall>& walls, const Pose2& T_room_body,
                         const BeamLayout& beams, const SensorModel& sensor, RandomGeometry& random) {
  RangeSample sample;
  sample.beam_count = beams.count;
  for (std::size_t i = 0; i < beams.count; ++i) {
    const auto range_m = cast_ray(walls, T_room_body * Pose2(0.0, 0.0, beams.bearing_rad[i]));
    const double noise_m = random.normal(sensor.range_sigma_m);
    sample.status[i] = RangeStatus::kNoReturn;
    if (!range_m || *range_m + noise_m > sensor.max_range_m) continue;
    sample.status[i] = RangeStatus::kHit;
    sample.distance_m[i] = static_cast<float>(*range_m + noise_m);
  }
  return sample;
}

/// In steps from sample to sample.
inline RoomDrive drive_along(const std::vector<RoomWall>& walls, const Pose2& T_room_start,
                             const std::vector<Pose2>& steps, const BeamLayout& beams,
                             const SensorModel& sensor, const DriveErrors& errors, unsigned seed) {
  RandomGeometry random(seed);
  RoomDrive drive;
  Pose2 T_room_body = T_room_start;
  Pose2 T_odom_body;
  for (std::size_t i = 0; i <= steps.size(); ++i) {
    drive.T_room_body.push_back(T_room_body);
    drive.samples.push_back(sense(walls, T_room_body, beams, sensor, random));
    RangeSample& sample = drive.samples.back();
    sample.sequence = static_cast<std::uint32_t>(i);
    sample.starts_segment = i == 0;
    sample.T_odom_body = T_odom_body;
    if (i == steps.size()) break;
    T_room_body = T_room_body * steps[i];
    const Eigen::Matrix3d covariance =
        uncertain_step(sensor.odometry, steps[i], std::chrono::milliseconds(100)).covariance;
    const double sigma_xy_m = errors.odometry_noise_scale * std::sqrt(covariance(0, 0));
    const double sigma_yaw_rad = errors.odometry_noise_scale * std::sqrt(covariance(2, 2));
    T_odom_body = T_odom_body * Pose2(steps[i].x_m() + random.normal(sigma_xy_m), random.normal(sigma_xy_m),
                                      steps[i].yaw_rad() + random.normal(sigma_yaw_rad) -
                                          errors.yaw_drift_rad_per_metre * steps[i].x_m());
  }
  return drive;
}

/// `laps` times around the ring of corridors, 0.04 m or 4 degrees a sample.
inline RoomDrive drive_around(int laps, const BeamLayout& beams, const SensorModel& sensor,
                              const DriveErrors& errors, unsigned seed) {
  std::vector<Pose2> steps;
  for (int side = 0; side < 4 * laps; ++side) {
    steps.insert(steps.end(), side % 2 == 0 ? 250 : 150, Pose2(0.04, 0.0, 0.0));
    for (int i = 0; i < 22; ++i) steps.emplace_back(0.0, 0.0, 0.5 * kPi / 22.0);
  }
  return drive_along(ring_of_corridors(), Pose2(1.0, 1.0, 0.0), steps, beams, sensor, errors, seed);
}

}  // namespace swiftlet::test

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/test_vehicle.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace swiftlet {

TestVehicle::TestVehicle(const TextRoom& room, const Pose2& T_world_body, const TestVehicleModel& model,
                         std::uint32_t seed)
    : model_(model), random_(seed), T_world_now_(T_world_body) {
  measure(room, true);
}

void TestVehicle::fly_to(const TextRoom& room, const Point2& goal_world) {
  const Point2 goal_body = T_world_now_.inverse() * goal_world;
  const double turn_rad = std::atan2(goal_body.y_m, goal_body.x_m);
  const double distance_m = std::hypot(goal_body.x_m, goal_body.y_m);
  const int turns = static_cast<int>(std::ceil(std::abs(turn_rad) / model_.turn_step_rad));
  for (int i = 0; i < turns; ++i) move(room, 0.0, turn_rad / turns);
  const int steps = static_cast<int>(std::ceil(distance_m / model_.step_m));
  for (int i = 0; i < steps; ++i) move(room, distance_m / steps, 0.0);
}

void TestVehicle::carry_to(const TextRoom& room, const Pose2& T_world_body) {
  T_world_now_ = T_world_body;
  T_odom_now_ = Pose2();
  measure(room, true);
}

void TestVehicle::move(const TextRoom& room, double forward_m, double turn_rad) {
  T_world_now_ = T_world_now_ * Pose2(forward_m, 0.0, turn_rad);
  std::normal_distribution<double> noise(0.0, 1.0);
  const double slip_x_m = model_.odometry_sigma_m * noise(random_);
  const double slip_y_m = model_.odometry_sigma_m * noise(random_);
  T_odom_now_ = T_odom_now_ * Pose2(model_.odometry_scale * forward_m + slip_x_m, slip_y_m,
                                    turn_rad + model_.drift_rad_per_m * forward_m);
  measure(room, false);
}

void TestVehicle::measure(const TextRoom& room, bool starts_segment) {
  RangeSample sample;
  sample.sequence = static_cast<std::uint32_t>(samples_.size());
  sample.measured_at = DeviceTime(std::chrono::milliseconds(100) * sample.sequence);
  sample.stamp = HostTime(std::chrono::milliseconds(100) * sample.sequence);
  sample.T_odom_body = T_odom_now_;
  sample.starts_segment = starts_segment;
  sample.beam_count = beams_.count;
  std::normal_distribution<double> noise(0.0, 1.0);
  for (std::size_t beam = 0; beam < beams_.count; ++beam) {
    const std::optional<double> range_m = room.range_m(
        T_world_now_.position(), T_world_now_.yaw_rad() + beams_.bearing_rad[beam], model_.max_range_m);
    const double error_m = model_.range_sigma_m * noise(random_);
    sample.status[beam] = range_m ? RangeStatus::kHit : RangeStatus::kNoReturn;
    if (range_m) sample.distance_m[beam] = static_cast<float>(std::max(0.0, *range_m + error_m));
  }
  samples_.push_back(sample);
  T_world_body_.push_back(T_world_now_);
}

}  // namespace swiftlet

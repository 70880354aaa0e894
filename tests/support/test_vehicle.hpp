// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "core/sensing/range_sample.hpp"
#include "core/sensing/sensor_model.hpp"
#include "tests/support/text_room.hpp"

namespace swiftlet {

/// How a TestVehicle moves and errs.
struct TestVehicleModel {
  double step_m = 0.05;           ///< travelled between two samples
  double turn_step_rad = 0.1;     ///< turned between two samples
  double range_sigma_m = 0.01;    ///< noise of a reading
  double max_range_m = 3.0;       ///< farther walls give no return
  double odometry_scale = 1.0;    ///< the dead reckoning's metre
  double drift_rad_per_m = 0.0;   ///< the dead reckoning's heading error
  double odometry_sigma_m = 0.0;  ///< noise of each step of dead reckoning
};

/// A quadrotor with a Multiranger in a TextRoom: turns on the spot, flies straight, stores what it
/// measured and where it truly was. Same seed, same flight.
class TestVehicle {
 public:
  TestVehicle(const TextRoom& room, const Pose2& T_world_body, const TestVehicleModel& model,
              std::uint32_t seed);

  /// Turns towards the goal the shorter way round and flies there. `room` may differ from call to call: the
  /// world may change during the flight.
  void fly_to(const TextRoom& room, const Point2& goal_world);
  /// Carried elsewhere by hand: the dead reckoning of the next sample does not continue.
  void carry_to(const TextRoom& room, const Pose2& T_world_body);

  [[nodiscard]] const std::vector<RangeSample>& samples() const { return samples_; }
  /// Truth, one for each sample.
  [[nodiscard]] const std::vector<Pose2>& T_world_body() const { return T_world_body_; }

 private:
  void move(const TextRoom& room, double forward_m, double turn_rad);
  void measure(const TextRoom& room, bool starts_segment);

  TestVehicleModel model_;
  BeamLayout beams_ = BeamLayout::multiranger();
  std::mt19937 random_;
  Pose2 T_odom_now_;
  Pose2 T_world_now_;
  std::vector<RangeSample> samples_;
  std::vector<Pose2> T_world_body_;
};

/// Truth, with the first pose as origin as in dead reckoning.
inline std::vector<Pose2> true_poses(const TestVehicle& vehicle) {
  std::vector<Pose2> T_map_body;
  for (const Pose2& T_world_body : vehicle.T_world_body())
    T_map_body.push_back(between(vehicle.T_world_body()[0], T_world_body));
  return T_map_body;
}

}  // namespace swiftlet

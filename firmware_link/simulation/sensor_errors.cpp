// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/sensor_errors.hpp"

#include <chrono>
#include <cmath>

#include "firmware_link/simulation/building_flight.hpp"

namespace swiftlet {
namespace {

/// A factor whose logarithm is normal.
double log_normal(NoiseSource& noise, double sigma) { return std::exp(noise.gaussian(sigma)); }

FlowOdometryModel draw_odometry(NoiseSource& noise) {
  FlowOdometryModel model;
  model.scale_spread = std::abs(noise.gaussian(0.03));
  model.scale_wander = 0.02 * log_normal(noise, 0.5);
  model.scale_wander_time_s = noise.uniform(2.0, 20.0);
  model.velocity_noise_m_s = noise.uniform(0.02, 0.08);
  model.yaw_bias_min_rad_s = 0.0;
  model.yaw_bias_max_rad_s = radians(10.0) / 60.0 * log_normal(noise, 0.6);
  model.yaw_walk_rad_sqrt_s = radians(0.6) * log_normal(noise, 0.4);
  model.turn_scale_spread = std::abs(noise.gaussian(0.01));
  model.slips_per_s = 1.0 / noise.uniform(40.0, 300.0);
  if (noise.chance(0.2)) {
    model.yaw_jumps_per_s = 1.0 / noise.uniform(60.0, 240.0);
    model.yaw_jump_min_rad = radians(2.0);
    model.yaw_jump_max_rad = radians(12.0);
  }
  model.loses_reverse_sign = noise.chance(0.08);
  return model;
}

RangerModel draw_ranger(NoiseSource& noise) {
  RangerModel model;
  const double quality = noise.uniform(0.0, 1.0);
  const auto between = [quality](double low_m, double high_m) { return low_m + quality * (high_m - low_m); };
  model.noise_by_range = {{1.25, between(0.003, 0.005)},
                          {1.75, between(0.007, 0.008)},
                          {2.25, between(0.011, 0.043)},
                          {2.75, between(0.021, 0.043)},
                          {3.5, between(0.040, 0.068)}};
  model.wild_share = noise.uniform(0.03, 0.15);
  model.phantom_share = noise.uniform(0.30, 0.49);
  return model;
}

}  // namespace

VehicleModel vehicle_model_in(const SimulatedWorld& world, std::uint64_t seed) {
  if (world.kind.empty()) return {};
  NoiseSource noise(seed, "sensor_errors");
  VehicleModel model;
  model.pilot = drawn_pilot(seed);
  model.odometry = draw_odometry(noise);
  model.odometry.floor_patches = world.floor_patches;
  model.ranger = draw_ranger(noise);
  model.range_age += std::chrono::microseconds(std::llround(noise.uniform(-1e5, 2e5)));
  model.tilt.calm_rad = radians(noise.uniform(1.0, 1.25));
  model.tilt.gust_rad = radians(noise.uniform(4.2, 6.5));
  return model;
}

}  // namespace swiftlet

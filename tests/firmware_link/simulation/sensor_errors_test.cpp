// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/sensor_errors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "firmware_link/simulation/building_generator.hpp"
#include "firmware_link/simulation/outline.hpp"

namespace swiftlet {
namespace {

const SimulatedWorld kBuilding{.walls = {}, .flight = {{{0.0, 0.0}}, {{1.0, 0.0}}}, .kind = "hall"};

std::vector<VehicleModel> vehicles() {
  std::vector<VehicleModel> models;
  for (std::uint64_t seed = 0; seed < 200; ++seed) models.push_back(vehicle_model_in(kBuilding, seed));
  return models;
}

/// Where dead reckoning ends, off the truth, as a share of the way.
double dead_reckoning_error(std::uint64_t seed) {
  const SimulatedWorld world = draw_building(seed);
  const VehicleModel model = vehicle_model_in(world, seed);
  SimulatedFlight flight(world, model.pilot, seed);
  FlowOdometry odometry(model.odometry, seed);
  const Pose2 start = flight.state().T_world_body;
  Pose2 last = start;
  double way_m = 0.0;
  while (!flight.is_over()) {
    flight.step();
    odometry.step(flight.state());
    way_m += distance_m(last.position(), flight.state().T_world_body.position());
    last = flight.state().T_world_body;
  }
  return distance_m(between(start, last).position(), odometry.T_odom_body().position()) / way_m;
}

TEST(SensorErrors, AreTheUsualOnesInAWorldDrawnByHand) {
  const VehicleModel model = vehicle_model_in(make_simulated_world("office").value(), 7);
  EXPECT_EQ(model.range_age, VehicleModel{}.range_age);
  EXPECT_TRUE(model.ranger.noise_by_range.empty());
  EXPECT_EQ(model.tilt.calm_rad, 0.0);
}

TEST(SensorErrors, LeaveDeadReckoningAsFarOffAsOnRealLogs) {
  std::vector<double> errors;
  for (std::uint64_t seed = 0; seed < 200; ++seed) errors.push_back(dead_reckoning_error(seed));
  std::ranges::sort(errors);
  EXPECT_GT(errors[100], 0.02);
  EXPECT_LT(errors[100], 0.045);
  const auto far_off = std::ranges::count_if(errors, [](double error) { return error > 0.08; });
  EXPECT_GE(far_off, 10);
  EXPECT_LE(far_off, 30);
}

TEST(SensorErrors, DelayRangesByATenthLessToTwoTenthsMore) {
  double least_s = 1.0;
  double most_s = -1.0;
  for (const VehicleModel& model : vehicles()) {
    const double lag_s = to_seconds(model.range_age - VehicleModel{}.range_age);
    least_s = std::min(least_s, lag_s);
    most_s = std::max(most_s, lag_s);
  }
  EXPECT_GE(least_s, -0.1);
  EXPECT_LT(least_s, -0.08);
  EXPECT_LE(most_s, 0.2);
  EXPECT_GT(most_s, 0.18);
}

TEST(SensorErrors, LoseTheSignAndJumpInAShareOfTheFlights) {
  int losing = 0;
  int jumping = 0;
  for (const VehicleModel& model : vehicles()) {
    losing += model.odometry.loses_reverse_sign ? 1 : 0;
    jumping += model.odometry.yaw_jumps_per_s > 0.0 ? 1 : 0;
  }
  EXPECT_GT(losing, 5);
  EXPECT_LT(losing, 40);
  EXPECT_GT(jumping, 20);
  EXPECT_LT(jumping, 80);
}

/// Readings of a wall at that distance, without those that were lost.
std::vector<double> readings_at(double distance_m, const RangerModel& model) {
  const std::vector<WallSegment> wall{{{distance_m, -9.0}, {distance_m, 9.0}}};
  NoiseSource noise(1, "range");
  std::vector<double> readings;
  for (int i = 0; i < 4000; ++i)
    if (const auto range_m = measure_range(wall, {}, 0.0, model, noise)) readings.push_back(*range_m);
  return readings;
}

/// Half of the range that holds 68 % of the errors: of the white noise, without the tails.
double central_sigma_m(double distance_m, const RangerModel& model) {
  std::vector<double> errors;
  for (const double reading_m : readings_at(distance_m, model))
    errors.push_back(std::abs(reading_m - distance_m));
  std::ranges::sort(errors);
  return errors[errors.size() * 68 / 100];
}

TEST(SensorErrors, ScatterRangesAsTheRealFlightsDo) {
  struct Measured {
    double distance_m;
    double least_m;
    double most_m;
  };
  constexpr Measured kMeasured[] = {
      {1.0, 0.003, 0.005}, {1.75, 0.007, 0.008}, {2.25, 0.011, 0.043}, {2.75, 0.021, 0.043}};
  const std::vector<VehicleModel> models = vehicles();
  for (std::size_t i = 0; i < 10; ++i) {
    for (const auto& [distance_m, least_m, most_m] : kMeasured) {
      const double sigma_m = central_sigma_m(distance_m, models[i].ranger);
      EXPECT_GT(sigma_m, 0.9 * least_m) << distance_m;
      EXPECT_LT(sigma_m, 1.35 * most_m) << distance_m;
    }
  }
}

TEST(SensorErrors, HaveTheTailsAndThePhantomsOfTheRealFlights) {
  const std::vector<VehicleModel> models = vehicles();
  for (std::size_t i = 0; i < 10; ++i) {
    const std::vector<double> near = readings_at(1.0, models[i].ranger);
    const double sigma_m = models[i].ranger.noise_by_range.front().sigma_m;
    const auto wild =
        std::ranges::count_if(near, [&](double r) { return std::abs(r - 1.0) > 3.0 * sigma_m; });
    const double wild_share = static_cast<double>(wild) / static_cast<double>(near.size());
    EXPECT_GT(wild_share, 0.025);
    EXPECT_LT(wild_share, 0.165);
    const std::vector<double> far = readings_at(3.2, models[i].ranger);
    const auto phantoms =
        std::ranges::count_if(far, [](double r) { return r > 3.6; });  // of 40 % of their span
    const double phantom_share = static_cast<double>(phantoms) / static_cast<double>(far.size()) / 0.4;
    EXPECT_GT(phantom_share, 0.2);
    EXPECT_LT(phantom_share, 0.7);
  }
}

}  // namespace
}  // namespace swiftlet

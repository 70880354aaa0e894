// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/spared_errors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "firmware_link/simulation/building_generator.hpp"
#include "firmware_link/simulation/sensor_errors.hpp"

namespace swiftlet {
namespace {

/// A seed with floors of which the flow sensor sees a part.
constexpr std::uint64_t kPatchySeed = 9;

double greatest_turn_error_rad(const VehicleModel& model, const SimulatedWorld& world) {
  SimulatedFlight flight(world, model.pilot, kPatchySeed);
  FlowOdometry odometry(model.odometry, kPatchySeed);
  const double start_rad = flight.state().T_world_body.yaw_rad();
  double greatest_rad = 0.0;
  while (!flight.is_over()) {
    flight.step();
    odometry.step(flight.state());
    const double turned_rad = flight.state().T_world_body.yaw_rad() - start_rad;
    greatest_rad =
        std::max(greatest_rad, std::abs(wrap_angle(odometry.T_odom_body().yaw_rad() - turned_rad)));
  }
  return greatest_rad;
}

/// What a name takes.
struct Named {
  const char* name;
  bool (*is_there)(const VehicleModel&);
};

const Named kNamed[] = {
    {"floors", [](const VehicleModel& m) { return !m.odometry.floor_patches.empty(); }},
    {"slips", [](const VehicleModel& m) { return m.odometry.slips_per_s > 0.0; }},
    {"scale", [](const VehicleModel& m) { return m.odometry.scale_spread > 0.0; }},
    {"wander", [](const VehicleModel& m) { return m.odometry.scale_wander > 0.0; }},
    {"flow", [](const VehicleModel& m) { return m.odometry.velocity_noise_m_s > 0.0; }},
    {"drift", [](const VehicleModel& m) { return m.odometry.turn_scale_spread > 0.0; }},
    {"walk", [](const VehicleModel& m) { return m.odometry.yaw_walk_rad_sqrt_s > 0.0; }},
    {"jumps", [](const VehicleModel& m) { return m.odometry.yaw_jumps_per_s > 0.0; }},
    {"sign", [](const VehicleModel& m) { return m.odometry.loses_reverse_sign; }},
    {"ranges", [](const VehicleModel& m) { return m.ranger.wild_share > 0.0; }},
    {"tilt", [](const VehicleModel& m) { return m.tilt.calm_rad > 0.0; }},
    {"lag", [](const VehicleModel& m) { return m.range_age != VehicleModel().range_age; }},
};

VehicleModel with_all_errors() {
  VehicleModel model = vehicle_model_in(draw_building(kPatchySeed), kPatchySeed);
  model.odometry.slips_per_s = model.odometry.yaw_jumps_per_s = 0.1;
  model.odometry.loses_reverse_sign = true;
  model.tilt.calm_rad = 0.1;
  return model;
}

/// Each its own, and nothing of another.
TEST(SparedErrors, EachNameTakesItsOwnAlone) {
  for (const Named& taken : kNamed) {
    VehicleModel model = with_all_errors();
    SparedErrors::parse(taken.name).value().take_from(model);
    for (const Named& other : kNamed)
      EXPECT_EQ(other.is_there(model), &other != &taken) << other.name << " without " << taken.name;
  }
}

TEST(SparedErrors, LeaveNoneOfTheHeadingWhereAllOfThemAreSpared) {
  const SimulatedWorld world = draw_building(kPatchySeed);
  VehicleModel model = vehicle_model_in(world, kPatchySeed);
  EXPECT_GT(greatest_turn_error_rad(model, world), radians(1.0));
  SparedErrors::parse("drift,walk,jumps").value().take_from(model);
  EXPECT_LT(greatest_turn_error_rad(model, world), 1e-6);
}

TEST(SparedErrors, RefuseAnUnknownNameWithThoseThereAre) {
  for (const char* text : {"", "gyro", "floors,,lag"}) {
    const auto spared = SparedErrors::parse(text);
    ASSERT_FALSE(spared.ok()) << text;
    EXPECT_THAT(spared.error().message, testing::HasSubstr("there are floors, slips, scale")) << text;
  }
}

}  // namespace
}  // namespace swiftlet

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

TEST(SparedErrors, LeaveTheOthersAsTheyAre) {
  const SimulatedWorld world = draw_building(kPatchySeed);
  const VehicleModel usual = vehicle_model_in(world, kPatchySeed);
  ASSERT_FALSE(usual.odometry.floor_patches.empty());
  VehicleModel spared = usual;
  SparedErrors::parse("floors,lag").value().take_from(spared);
  EXPECT_TRUE(spared.odometry.floor_patches.empty());
  EXPECT_EQ(spared.range_age, VehicleModel().range_age);
  EXPECT_NE(usual.range_age, spared.range_age);
  EXPECT_EQ(spared.odometry.velocity_noise_m_s, usual.odometry.velocity_noise_m_s);
  EXPECT_EQ(spared.ranger.noise_by_range.size(), usual.ranger.noise_by_range.size());
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

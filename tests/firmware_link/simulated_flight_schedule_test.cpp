// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulated_flight_schedule.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// 1 m/s along x for one second, half a metre above the floor.
std::vector<FlightState> one_metre() {
  std::vector<FlightState> states;
  for (int i = 0; i <= 100; ++i)
    states.push_back({.T_world_body = Pose2(0.01 * i, 0.0, 0.0), .vx_body_m_s = 1.0, .height_m = 0.5});
  return states;
}

TEST(FlightSchedule, StandsUntilItGoes) {
  const FlightSchedule flight(one_metre());
  EXPECT_FALSE(flight.is_going());
  EXPECT_EQ(flight.progress(seconds(100)), 0.0);
  EXPECT_EQ(flight.state(seconds(100)).height_m, 0.0) << "on the ground";
  EXPECT_EQ(flight.T_world_body(seconds(100)).x_m(), 0.0);
}

TEST(FlightSchedule, FollowsItsStatesAndBetweenThem) {
  FlightSchedule flight(one_metre());
  flight.go(seconds(10));
  EXPECT_TRUE(flight.is_at_step(seconds(10) + milliseconds(250)));
  EXPECT_FALSE(flight.is_at_step(seconds(10) + milliseconds(255)));
  EXPECT_EQ(flight.state(seconds(10) + milliseconds(255)).T_world_body.x_m(), 0.25);
  EXPECT_NEAR(flight.T_world_body(seconds(10) + milliseconds(255)).x_m(), 0.255, 1e-12);
  EXPECT_EQ(flight.flown(seconds(10) + milliseconds(255)), milliseconds(250));
  EXPECT_FALSE(flight.is_over(seconds(10) + milliseconds(999)));
  EXPECT_TRUE(flight.is_over(seconds(11)));
  EXPECT_EQ(flight.T_world_body(seconds(20)).x_m(), 1.0);
}

TEST(FlightSchedule, HoldsTheVehicleWhileInterruptedAndGoesOnFromThere) {
  FlightSchedule flight(one_metre());
  flight.go(seconds(0));
  flight.halt(milliseconds(400));
  EXPECT_FALSE(flight.is_going());
  EXPECT_EQ(flight.state(seconds(3)).T_world_body.x_m(), 0.4);
  EXPECT_EQ(flight.state(seconds(3)).vx_body_m_s, 0.0);
  flight.go(seconds(5));
  EXPECT_NEAR(flight.T_world_body(milliseconds(5300)).x_m(), 0.7, 1e-12);
  EXPECT_NEAR(flight.T_world_body(seconds(4)).x_m(), 0.4, 1e-12) << "the past stays what it was";
  EXPECT_NEAR(flight.T_world_body(milliseconds(200)).x_m(), 0.2, 1e-12);
  EXPECT_TRUE(flight.is_over(milliseconds(5600)));
}

TEST(FlightSchedule, GoesNoFurtherWhenOver) {
  FlightSchedule flight(one_metre());
  flight.go(seconds(0));
  flight.halt(seconds(2));
  flight.go(seconds(3));
  EXPECT_FALSE(flight.is_going());
  EXPECT_EQ(flight.progress(seconds(4)), 1.0);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/flight_schedule.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "tests/support/flown_states.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const SimulatedWorld kHop{{}, {{{0.0, 0.0}}, {{2.0, 1.0}}, {{3.0, 3.0}}}};

std::vector<FlightState> states_of_hop() { return fly(kHop, PilotModel{}, 1); }
Duration duration_of_hop() { return (states_of_hop().size() - 1) * kFlightStep; }
FlightSchedule hop_schedule() { return FlightSchedule(SimulatedFlight(kHop, PilotModel{}, 1)); }

TEST(FlightSchedule, StandsUntilItGoes) {
  FlightSchedule flight = hop_schedule();
  EXPECT_FALSE(flight.is_going());
  EXPECT_EQ(flight.progress(seconds(100)), 0.0);
  EXPECT_EQ(flight.state(seconds(100)).height_m, 0.0) << "on the ground";
  EXPECT_EQ(flight.T_world_body(seconds(100)).x_m(), 0.0);
}

TEST(FlightSchedule, FollowsItsStatesAndBetweenThem) {
  const std::vector<FlightState> states = states_of_hop();
  FlightSchedule flight = hop_schedule();
  flight.go(seconds(10));
  EXPECT_TRUE(flight.is_at_step(milliseconds(14'250)));
  EXPECT_FALSE(flight.is_at_step(milliseconds(14'255)));
  EXPECT_EQ(flight.state(milliseconds(14'255)).vx_body_m_s, states[425].vx_body_m_s);
  EXPECT_EQ(flight.state(milliseconds(14'255)).T_world_body.vector(), states[425].T_world_body.vector());
  EXPECT_NEAR(flight.T_world_body(milliseconds(14'255)).x_m(),
              (states[425].T_world_body.x_m() + states[426].T_world_body.x_m()) / 2.0, 1e-12);
  EXPECT_EQ(flight.flown(milliseconds(14'255)), milliseconds(4250));
}

TEST(FlightSchedule, IsOverAtTheLastState) {
  FlightSchedule flight = hop_schedule();
  flight.go(seconds(10));
  EXPECT_FALSE(flight.is_over(seconds(10) + duration_of_hop() - milliseconds(1)));
  EXPECT_TRUE(flight.is_over(seconds(10) + duration_of_hop()));
  EXPECT_EQ(flight.progress(seconds(10) + duration_of_hop() / 2), 0.5);
  EXPECT_EQ(flight.T_world_body(seconds(100)).vector(), states_of_hop().back().T_world_body.vector());
}

TEST(FlightSchedule, HoldsTheVehicleWhileInterruptedAndContinuesFromThere) {
  const std::vector<FlightState> states = states_of_hop();
  FlightSchedule flight = hop_schedule();
  flight.go(seconds(0));
  flight.halt(milliseconds(4000));
  EXPECT_FALSE(flight.is_going());
  EXPECT_EQ(flight.state(seconds(7)).T_world_body.vector(), states[400].T_world_body.vector());
  EXPECT_EQ(flight.state(seconds(7)).vx_body_m_s, 0.0);
  flight.go(seconds(9));
  EXPECT_EQ(flight.T_world_body(milliseconds(9300)).vector(), states[430].T_world_body.vector());
  EXPECT_EQ(flight.T_world_body(seconds(8)).vector(), states[400].T_world_body.vector())
      << "the past stays what it was";
  EXPECT_EQ(flight.T_world_body(milliseconds(2000)).vector(), states[200].T_world_body.vector());
  EXPECT_TRUE(flight.is_over(seconds(5) + duration_of_hop()));
}

TEST(FlightSchedule, HoldsTheVehicleOnTheStairs) {
  const SimulatedWorld stairs{{}, {{{0.0, 0.0}}, {.position = {5.0, 0.0}, .storey = 1}}};
  FlightSchedule flight(SimulatedFlight(stairs, PilotModel{}, 1));
  flight.go(seconds(0));
  const double ground_m = flight.state(seconds(10)).ground_m;
  EXPECT_GT(ground_m, 0.5);
  flight.halt(seconds(10));
  EXPECT_EQ(flight.state(seconds(11)).ground_m, ground_m);
  EXPECT_EQ(flight.state(seconds(11)).height_m, 0.0);
}

TEST(FlightSchedule, StaysInItsLastStateWhenOver) {
  FlightSchedule flight = hop_schedule();
  flight.go(seconds(0));
  flight.halt(seconds(60));
  flight.go(seconds(70));
  EXPECT_FALSE(flight.is_going());
  EXPECT_EQ(flight.progress(seconds(71)), 1.0);
}

TEST(FlightSchedule, RemembersAMinuteAlsoAfterAQueryOneMinuteAhead) {
  PilotModel pilot;
  pilot.laps = 30;
  const std::vector<FlightState> states = fly(kHop, pilot, 1);
  FlightSchedule flight(SimulatedFlight(kHop, pilot, 1));
  flight.go(seconds(0));
  EXPECT_EQ(flight.T_world_body(seconds(180)).vector(), states[18'000].T_world_body.vector());
  EXPECT_EQ(flight.state(seconds(120)).T_world_body.vector(), states[12'000].T_world_body.vector());
  EXPECT_EQ(flight.T_world_body(milliseconds(61'000)).vector(), states[6100].T_world_body.vector());
  EXPECT_NE(flight.T_world_body(seconds(0)).vector(), states[0].T_world_body.vector()) << "long ago";
}

}  // namespace
}  // namespace swiftlet

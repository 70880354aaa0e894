// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulated_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace swiftlet {
namespace {

constexpr double kStepS = 0.01;

PilotModel steady_pilot() {
  PilotModel pilot;
  pilot.wander_m = 0.0;
  pilot.wander_yaw_rad = 0.0;
  pilot.wander_speed_share = 0.0;
  return pilot;
}

TEST(Fly, RisesFliesToTheEndAndLandsThere) {
  const SimulatedWorld world{{}, {{{1.0, 2.0}}, {{4.0, 2.0}}}};
  const std::vector<FlightState> flight = fly(world, steady_pilot(), 1);
  EXPECT_EQ(flight.front().height_m, 0.0);
  EXPECT_EQ(flight.front().T_world_body.x_m(), 1.0);
  EXPECT_EQ(flight.front().T_world_body.yaw_rad(), 0.0);
  EXPECT_NEAR(flight[flight.size() / 2].height_m, 0.5, 1e-6);
  EXPECT_EQ(flight.back().height_m, 0.0);
  EXPECT_NEAR(flight.back().T_world_body.x_m(), 4.0, 0.15);
  EXPECT_NEAR(flight.back().T_world_body.y_m(), 2.0, 1e-6);
}

TEST(Fly, CruisesAtThePilotsSpeed) {
  const SimulatedWorld world{{}, {{{0.0, 0.0}}, {{20.0, 0.0}}}};
  const std::vector<FlightState> flight = fly(world, steady_pilot(), 1);
  EXPECT_NEAR(flight[flight.size() / 2].vx_body_m_s, 0.5, 0.01);
  EXPECT_NEAR(flight[flight.size() / 2].vy_body_m_s, 0.0, 1e-6);
}

TEST(Fly, TurnsTheNoseIntoTheDirectionOfTravel) {
  const SimulatedWorld world{{}, {{{0.0, 0.0}}, {{3.0, 0.0}}, {{3.0, 4.0}}}};
  EXPECT_NEAR(fly(world, steady_pilot(), 1).back().T_world_body.yaw_rad(), kPi / 2.0, 0.02);
}

TEST(Fly, KeepsTheNoseWhereItPointsWhenTold) {
  const SimulatedWorld world{{}, {{{0.0, 0.0}}, {{3.0, 0.0}}, {{0.0, 0.0}, PilotHeading::kKeep}}};
  const std::vector<FlightState> flight = fly(world, steady_pilot(), 1);
  EXPECT_NEAR(flight.back().T_world_body.yaw_rad(), 0.0, 0.02);
  EXPECT_NEAR(flight.back().T_world_body.x_m(), 0.0, 0.15);
  const auto slowest = std::ranges::min_element(flight, {}, &FlightState::vx_body_m_s);
  EXPECT_NEAR(slowest->vx_body_m_s, -0.5, 0.01);
}

TEST(Fly, LooksAroundOnTheSpot) {
  const SimulatedWorld world{
      {}, {{{0.0, 0.0}}, {{2.0, 0.0}, PilotHeading::kIntoTravel, 2.0 * kPi}, {{4.0, 0.0}}}};
  double turned_rad = 0.0;
  for (const FlightState& state : fly(world, steady_pilot(), 1)) {
    turned_rad += state.yaw_rate_rad_s * kStepS;
    if (std::abs(state.yaw_rate_rad_s) > 0.5) {
      EXPECT_NEAR(state.T_world_body.x_m(), 2.0, 0.2);
    }
  }
  EXPECT_NEAR(turned_rad, 2.0 * kPi, 0.05);
}

TEST(Fly, IsSmoothAndWithinThePilotsLimits) {
  const SimulatedWorld world = make_simulated_world("office").value();
  const std::vector<FlightState> flight = fly(world, PilotModel{}, 3);
  for (std::size_t i = 1; i < flight.size(); ++i) {
    const Pose2 step = between(flight[i - 1].T_world_body, flight[i].T_world_body);
    ASSERT_LT(std::hypot(step.x_m(), step.y_m()), 0.7 * kStepS);
    ASSERT_LE(std::abs(step.yaw_rad()), radians(60.0) * kStepS + 1e-9);
    ASSERT_NEAR(step.yaw_rad(), flight[i].yaw_rate_rad_s * kStepS, 1e-9);
    ASSERT_NEAR(std::hypot(step.x_m(), step.y_m()),
                std::hypot(flight[i].vx_body_m_s, flight[i].vy_body_m_s) * kStepS, 1e-9);
  }
}

TEST(Fly, IsTheSameForTheSameSeedOnly) {
  const SimulatedWorld world = make_simulated_world("maze").value();
  const std::vector<FlightState> flight = fly(world, PilotModel{}, 3);
  const std::vector<FlightState> same = fly(world, PilotModel{}, 3);
  const std::vector<FlightState> other = fly(world, PilotModel{}, 4);
  ASSERT_EQ(flight.size(), same.size());
  EXPECT_EQ(flight[5000].T_world_body.vector(), same[5000].T_world_body.vector());
  EXPECT_NE(flight[5000].T_world_body.vector(), other[5000].T_world_body.vector());
}

TEST(Fly, FliesAClosedScriptAsOftenAsTold) {
  const SimulatedWorld square{{}, {{{0.0, 0.0}}, {{2.0, 0.0}}, {{2.0, 2.0}}, {{0.0, 2.0}}, {{0.0, 0.0}}}};
  PilotModel pilot = steady_pilot();
  const std::size_t once = fly(square, pilot, 1).size();
  pilot.laps = 3;
  const std::vector<FlightState> flight = fly(square, pilot, 1);
  EXPECT_GT(flight.size(), 5 * once / 2);
  EXPECT_EQ(std::ranges::count(flight, 0.0, &FlightState::height_m), 2) << "it lands once";
  EXPECT_NEAR(flight.back().T_world_body.x_m(), 0.0, 0.15);
}

TEST(Fly, ReturnsAlongAnOpenScriptBetweenTwoLaps) {
  const SimulatedWorld corner{{}, {{{0.0, 0.0}}, {{3.0, 0.0}}, {{3.0, 3.0}}}};
  PilotModel pilot = steady_pilot();
  pilot.laps = 2;
  for (const FlightState& state : fly(corner, pilot, 1)) {
    const Point2 at = state.T_world_body.position();
    EXPECT_LT(std::min(std::abs(at.y_m), std::abs(at.x_m - 3.0)), 0.4) << "on one of the two lines";
  }
  EXPECT_NEAR(fly(corner, pilot, 1).back().T_world_body.y_m(), 3.0, 0.15);
}

}  // namespace
}  // namespace swiftlet

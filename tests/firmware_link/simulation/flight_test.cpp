// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/support/flown_states.hpp"

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

TEST(Fly, KeepsTheHeadingWhereTheScriptSaysSo) {
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

TEST(Fly, HoversWhereTheScriptSaysSo) {
  const std::size_t without = fly({{}, {{{0.0, 0.0}}, {{2.0, 0.0}}, {{4.0, 0.0}}}}, steady_pilot(), 1).size();
  const SimulatedWorld world{{},
                             {{{0.0, 0.0}}, {{2.0, 0.0}, PilotHeading::kIntoTravel, 0.0, 5.0}, {{4.0, 0.0}}}};
  const std::vector<FlightState> flight = fly(world, steady_pilot(), 1);
  EXPECT_GT(flight.size(), without + 500);
  const auto at_rest = std::ranges::count_if(flight, [](const FlightState& state) {
    return state.T_world_body.x_m() > 1.8 && state.T_world_body.x_m() < 2.1 &&
           std::abs(state.vx_body_m_s) < 0.1;
  });
  EXPECT_GT(at_rest, 450);
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

TEST(Fly, RepeatsAClosedScriptAsOftenAsRequested) {
  const SimulatedWorld square{{}, {{{0.0, 0.0}}, {{2.0, 0.0}}, {{2.0, 2.0}}, {{0.0, 2.0}}, {{0.0, 0.0}}}};
  PilotModel pilot = steady_pilot();
  const std::size_t once = fly(square, pilot, 1).size();
  pilot.laps = 3;
  const std::vector<FlightState> flight = fly(square, pilot, 1);
  EXPECT_GT(flight.size(), 5 * once / 2);
  EXPECT_EQ(std::ranges::count(flight, 0.0, &FlightState::height_m), 2) << "it lands once";
  EXPECT_NEAR(flight.back().T_world_body.x_m(), 0.0, 0.15);
}

TEST(Fly, FliesTheSameLapsInAThousandAsInTwo) {
  const SimulatedWorld patrol = make_simulated_world("patrol").value();
  PilotModel pilot;
  pilot.laps = 2;
  const std::vector<FlightState> two = fly(patrol, pilot, 1);
  pilot.laps = kMaxLaps;
  SimulatedFlight many(patrol, pilot, 1);
  const std::size_t landing = 600;  // the last metres and the descent
  for (std::size_t i = 0; i + landing < two.size(); ++i, many.step())
    ASSERT_EQ(many.state().T_world_body.vector(), two[i].T_world_body.vector()) << i;
}

TEST(Fly, StaysOnTheGroundWhenItIsOver) {
  SimulatedFlight flight({{}, {{{0.0, 0.0}}, {{1.0, 0.0}}}}, steady_pilot(), 1);
  while (!flight.is_over()) flight.step();
  const FlightState landed = flight.state();
  flight.step();
  EXPECT_EQ(flight.state().T_world_body.vector(), landed.T_world_body.vector());
  EXPECT_EQ(flight.state().height_m, 0.0);
}

/// 3 m on storey 0, stairs of 5 m, 3 m on storey 1.
SimulatedWorld with_stairs() {
  return {{},
          {{{0.0, 0.0}},
           {{3.0, 0.0}},
           {.position = {8.0, 0.0}, .storey = 1},
           {.position = {8.0, 3.0}, .storey = 1}}};
}

TEST(Fly, ClimbsStairsAtItsHeightAboveThem) {
  const std::vector<FlightState> flight = fly(with_stairs(), steady_pilot(), 1);
  EXPECT_EQ(flight.front().ground_m, 0.0);
  EXPECT_EQ(flight.back().ground_m, 3.2);
  for (std::size_t i = 1; i < flight.size(); ++i) {
    const double along_m = flight[i].T_world_body.x_m() - 3.1;  // the landings are 0.1 m
    ASSERT_NEAR(flight[i].ground_m, 3.2 * std::clamp(along_m / 4.8, 0.0, 1.0), 1e-9) << i;
    ASSERT_LT(std::abs(flight[i].ground_m - flight[i - 1].ground_m), 0.22 * kStepS) << i;
    if (along_m > 0.0 && along_m < 4.8) {
      ASSERT_NEAR(flight[i].height_m, 0.5, 1e-9);
      ASSERT_LT(std::abs(flight[i].vx_body_m_s), 0.35);
    }
  }
}

TEST(Fly, ReturnsDownTheStairsBetweenTwoLaps) {
  PilotModel pilot = steady_pilot();
  pilot.laps = 2;
  const std::vector<FlightState> flight = fly(with_stairs(), pilot, 1);
  double climbed_m = 0.0;
  for (std::size_t i = 1; i < flight.size(); ++i)
    climbed_m += std::abs(flight[i].ground_m - flight[i - 1].ground_m);
  EXPECT_NEAR(climbed_m, 3.0 * 3.2, 0.01) << "up, down and up";
  EXPECT_EQ(flight.back().ground_m, 3.2);
}

TEST(RepeatedScript, IsOpenWhereItEndsAboveItsBeginning) {
  const RepeatedScript script({{{0.0, 0.0}}, {{5.0, 0.0}}, {.position = {0.0, 0.0}, .storey = 1}}, 2);
  EXPECT_EQ(script.passes(), 3);
  EXPECT_EQ(script[2].storey, 1);
  EXPECT_EQ(script[3].storey, 0);
}

TEST(RepeatedScript, RestartsAtTheEndOfAClosedScript) {
  const RepeatedScript script({{{0.0, 0.0}}, {{1.0, 0.0}}, {{2.0, 0.0}, {}, 3.0}, {{0.0, 0.0}}}, 3);
  ASSERT_EQ(script.size(), 10U);
  EXPECT_EQ(script.passes(), 3);
  std::vector<double> x_m;
  for (std::size_t i = 0; i < script.size(); ++i) x_m.push_back(script[i].position.x_m);
  EXPECT_EQ(x_m, (std::vector<double>{0, 1, 2, 0, 1, 2, 0, 1, 2, 0}));
  EXPECT_EQ(script[5].spin_rad, 3.0);
}

TEST(RepeatedScript, GoesBackAlongAnOpenScriptWithoutLookingAround) {
  const RepeatedScript script({{{0.0, 0.0}}, {{1.0, 0.0}, {}, 3.0}, {{2.0, 0.0}}}, 3);
  std::vector<double> x_m;
  std::vector<double> spins;
  for (std::size_t i = 0; i < script.size(); ++i) {
    x_m.push_back(script[i].position.x_m);
    spins.push_back(script[i].spin_rad);
  }
  EXPECT_EQ(x_m, (std::vector<double>{0, 1, 2, 1, 0, 1, 2, 1, 0, 1, 2}));
  EXPECT_EQ(script.passes(), 5);
  EXPECT_EQ(spins, (std::vector<double>{0, 3, 0, 0, 0, 3, 0, 0, 0, 3, 0}));
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

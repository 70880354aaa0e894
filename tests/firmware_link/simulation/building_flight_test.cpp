// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/building_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/flown_states.hpp"

namespace swiftlet {
namespace {

BuildingPlan ring_with_bridge() {
  BuildingPlan plan;
  plan.add_corridor({{0.0, 0.0}, {12.0, 0.0}, {12.0, 8.0}, {0.0, 8.0}}, 2.0, true);
  plan.add_corridor({{6.0, 0.0}, {6.0, 8.0}}, 2.0);
  return plan;
}

std::vector<Waypoint> flight(std::uint64_t seed, double duration_s) {
  FreeSpaceGrid grid(ring_with_bridge());
  NoiseSource noise(seed, "flight");
  return draw_flight(grid, drawn_pilot(seed), duration_s, noise);
}

TEST(BuildingFlight, TakesAboutTheTimeAskedFor) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const double flown_s =
        0.01 * static_cast<double>(fly({{}, flight(seed, 200.0)}, drawn_pilot(seed), seed).size());
    EXPECT_GT(flown_s, 150.0) << seed;
    EXPECT_LT(flown_s, 250.0) << seed;
  }
}

TEST(BuildingFlight, StaysClearOfTheWalls) {
  const std::vector<WallSegment> walls = ring_with_bridge().walls();
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    for (const FlightState& state : fly({walls, flight(seed, 120.0)}, drawn_pilot(seed), seed))
      for (const WallSegment& wall : walls)
        ASSERT_GT(distance_m(wall, state.T_world_body.position()), 0.2) << seed;
}

TEST(BuildingFlight, HoversSpinsSidestepsReversesAndReturns) {
  int hovers = 0;
  int spins = 0;
  int returns = 0;
  double sideways_m = 0.0;
  double backwards_m = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<Waypoint> script = flight(seed, 200.0);
    for (const Waypoint& waypoint : script) {
      hovers += waypoint.hover_s > 0.0 ? 1 : 0;
      spins += waypoint.spin_rad != 0.0 ? 1 : 0;
    }
    returns += distance_m(script.front().position, script.back().position) < 1.0 ? 1 : 0;
    for (const FlightState& state : fly({{}, script}, drawn_pilot(seed), seed)) {
      if (std::abs(state.vy_body_m_s) > 0.2) sideways_m += 0.01 * std::abs(state.vy_body_m_s);
      if (state.vx_body_m_s < -0.2) backwards_m -= 0.01 * state.vx_body_m_s;
    }
  }
  EXPECT_GT(hovers, 20);
  EXPECT_GT(spins, 20);
  EXPECT_GT(returns, 5);
  EXPECT_GT(sideways_m, 20.0);
  EXPECT_GT(backwards_m, 20.0);
}

TEST(BuildingFlight, GoesRoundWhereThereIsAWayRound) {
  int rounds = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    bool is_left = false;
    bool is_right = false;
    for (const Waypoint& waypoint : flight(seed, 300.0)) {
      is_left |= waypoint.position.x_m < 1.0;
      is_right |= waypoint.position.x_m > 11.0;
    }
    rounds += is_left && is_right ? 1 : 0;
  }
  EXPECT_GT(rounds, 15);
}

}  // namespace
}  // namespace swiftlet

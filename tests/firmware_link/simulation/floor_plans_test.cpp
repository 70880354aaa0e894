// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware_link/simulation/world.hpp"
#include "tests/support/flown_states.hpp"

namespace swiftlet {
namespace {

double clearance_m(const SimulatedWorld& world, const Point2& p, double ground_m) {
  double nearest_m = INFINITY;
  for (const WallSegment& wall : world.walls_at(ground_m))
    nearest_m = std::min(nearest_m, distance_to_segment_m(p, wall.start, wall.end));
  return nearest_m;
}
double clearance_m(const SimulatedWorld& world, const FlightState& state) {
  return clearance_m(world, state.T_world_body.position(), state.ground_m);
}

/// One state a second.
std::vector<FlightState> track(const SimulatedWorld& world, std::uint64_t seed) {
  const std::vector<FlightState> flight = fly(world, PilotModel{}, seed);
  std::vector<FlightState> states;
  for (std::size_t i = 0; i < flight.size(); i += 100) states.push_back(flight[i]);
  return states;
}

/// Share of the flight at places (0.3 m, 1 m in height) to which the vehicle came back half a minute later or
/// more, its nose turned by no more than, or by at least, a right angle against the first time.
struct Revisits {
  double same_way = 0.0;
  double other_way = 0.0;
};
Revisits revisits(const std::vector<FlightState>& states) {
  Revisits share;
  for (std::size_t i = 0; i < states.size(); ++i) {
    bool same_way = false;
    bool other_way = false;
    for (std::size_t j = i + 30; j < states.size(); ++j) {
      const Pose2 step = between(states[i].T_world_body, states[j].T_world_body);
      const bool is_elsewhere = std::abs(states[i].ground_m - states[j].ground_m) > 1.0;
      if (is_elsewhere || std::hypot(step.x_m(), step.y_m()) > 0.3) continue;
      (std::abs(step.yaw_rad()) < kPi / 2.0 ? same_way : other_way) = true;
    }
    share.same_way += same_way ? 1.0 : 0.0;
    share.other_way += other_way ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(states.size());
  return {share.same_way / count, share.other_way / count};
}

/// Those drawn by hand.
std::vector<std::string> world_names() {
  std::vector<std::string> names;
  for (const WorldPlan& plan : simulated_worlds())
    if (plan.name != "building") names.emplace_back(plan.name);
  return names;
}
std::vector<std::string> building_names() {
  std::vector<std::string> names = world_names();
  std::erase(names, "patrol");
  return names;
}

class FloorPlans : public testing::TestWithParam<std::string> {
 protected:
  const SimulatedWorld world_ = make_simulated_world(GetParam()).value();
};
INSTANTIATE_TEST_SUITE_P(All, FloorPlans, testing::ValuesIn(world_names()),
                         [](const auto& world) { return world.param; });

class Buildings : public FloorPlans {};
INSTANTIATE_TEST_SUITE_P(All, Buildings, testing::ValuesIn(building_names()),
                         [](const auto& world) { return world.param; });

TEST_P(FloorPlans, AreFlownWithoutTouchingAWallByAnyPilot) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    double nearest_m = INFINITY;
    for (const FlightState& state : fly(world_, PilotModel{}, seed))
      nearest_m = std::min(nearest_m, clearance_m(world_, state));
    EXPECT_GT(nearest_m, 0.25) << "seed " << seed;
  }
}

TEST_P(FloorPlans, HaveNoHoleToTheOutside) {
  for (const FlightState& state : track(world_, 1)) {
    const Point2 at = state.T_world_body.position();
    for (int degree = 0; degree < 360; degree += 5)
      EXPECT_TRUE(cast_ray(world_.walls_at(state.ground_m), at, radians(degree), 40.0))
          << at.x_m << ", " << at.y_m << " towards " << degree << " degrees";
  }
}

TEST_P(FloorPlans, KeepWallsWithinReachOfTheSensors) {
  for (const FlightState& state : track(world_, 1)) EXPECT_LT(clearance_m(world_, state), 2.5);
}

TEST_P(Buildings, AreFlownForSeveralMinutes) {
  const std::size_t duration_s = track(world_, 1).size();
  EXPECT_GT(duration_s, 240U);
  EXPECT_LT(duration_s, 480U);
}

TEST_P(Buildings, AreRevisitedInTheSameAndInTheOtherDirection) {
  const Revisits share = revisits(track(world_, 1));
  EXPECT_GT(share.same_way, 0.1);
  EXPECT_GT(share.other_way, 0.1);
}

TEST(Patrol, IsAClosedLapOfUnderAMinute) {
  const SimulatedWorld world = make_simulated_world("patrol").value();
  const std::size_t duration_s = track(world, 1).size();
  EXPECT_GT(duration_s, 44U) << "a thousand rounds are twelve hours";
  EXPECT_LT(duration_s, 64U);
  EXPECT_EQ(world.flight.front().position.x_m, world.flight.back().position.x_m);
  EXPECT_EQ(world.flight.front().position.y_m, world.flight.back().position.y_m);
}

/// Of the legs between waypoints of one storey and, on stairs, of both.
double script_clearance_m(const SimulatedWorld& world) {
  double nearest_m = INFINITY;
  for (std::size_t i = 1; i < world.flight.size(); ++i) {
    const Waypoint& from = world.flight[i - 1];
    const Waypoint& to = world.flight[i];
    for (int percent = 0; percent <= 100; ++percent) {
      const double share = percent / 100.0;
      const Point2 at{from.position.x_m + share * (to.position.x_m - from.position.x_m),
                      from.position.y_m + share * (to.position.y_m - from.position.y_m)};
      for (const int storey : {from.storey, to.storey})
        nearest_m = std::min(nearest_m, clearance_m(world, at, storey * world.storey_height_m));
    }
  }
  return nearest_m;
}

/// Of the directions in which a wall of either storey is seen from there: share where the other one's is more
/// than 0.3 m nearer or farther.
double share_that_differs(const SimulatedWorld& world, const Point2& at) {
  int differ = 0;
  int seen = 0;
  for (int degree = 0; degree < 360; degree += 5) {
    const auto below = cast_ray(world.walls_at(0.0), at, radians(degree), 3.0);
    const auto above = cast_ray(world.walls_at(world.storey_height_m), at, radians(degree), 3.0);
    seen += below || above ? 1 : 0;
    if (below.has_value() != above.has_value() ||
        (below && std::abs(below->distance_m - above->distance_m) > 0.3))
      ++differ;
  }
  return static_cast<double>(differ) / seen;
}

class Storeys : public testing::Test {
 protected:
  const SimulatedWorld world_ = make_simulated_world("storeys").value();
  const std::vector<FlightState> flight_ = fly(world_, PilotModel{}, 1);
};

TEST_F(Storeys, KeepTheScriptClearOfTheWallsOfItsStorey) { EXPECT_GE(script_clearance_m(world_), 0.4); }

TEST_F(Storeys, AreFlownForFourToSevenMinutesBackToTheStart) {
  const Duration duration = static_cast<std::int64_t>(flight_.size()) * kFlightStep;
  EXPECT_GT(duration, std::chrono::minutes(4));
  EXPECT_LT(duration, std::chrono::minutes(7));
  EXPECT_LT(distance_m(flight_.front().T_world_body.position(), flight_.back().T_world_body.position()), 0.2);
}

TEST_F(Storeys, AreJoinedByStairsThatAreFlownUpAndDownOnce) {
  const auto ground_m = [this](std::size_t tenth) {
    return flight_[tenth * (flight_.size() - 1) / 10].ground_m;
  };
  EXPECT_EQ(ground_m(0), 0.0);
  EXPECT_EQ(ground_m(6), 3.2);
  EXPECT_EQ(ground_m(10), 0.0);
  double way_up_m = 0.0;
  double way_down_m = 0.0;
  for (std::size_t i = 1; i < flight_.size(); ++i) {
    const double rise_m = flight_[i].ground_m - flight_[i - 1].ground_m;
    (rise_m > 0.0 ? way_up_m : way_down_m) += rise_m;
    ASSERT_LT(std::abs(rise_m), 0.22 * kFlightStepS) << i;
  }
  EXPECT_NEAR(way_up_m, 3.2, 0.1);
  EXPECT_NEAR(way_down_m, -3.2, 0.1);
}

TEST_F(Storeys, LookTheSameOnTheStairsAndOtherwiseInTheRooms) {
  EXPECT_LT(share_that_differs(world_, {8.1, 11.3}), 0.05);
  for (const Point2& room : {Point2{2.5, 2.5}, {8.2, 2.5}, {13.5, 2.5}, {2.2, 9.0}, {8.0, 8.6}, {14.0, 9.0}})
    EXPECT_GT(share_that_differs(world_, room), 0.3) << room.x_m << ", " << room.y_m;
}

TEST(MakeSimulatedWorld, ListsTheWorldsForAnUnknownName) {
  const Result<SimulatedWorld> world = make_simulated_world("attic");
  ASSERT_FALSE(world.ok());
  EXPECT_EQ(world.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(world.error().message,
            "no simulated world is called \"attic\"; choose one of: " + simulated_world_names());
  EXPECT_TRUE(simulated_world_names().starts_with("office, maze, "));
}

}  // namespace
}  // namespace swiftlet

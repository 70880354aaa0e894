// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "firmware_link/simulation/world.hpp"
#include "tests/support/flown_states.hpp"

namespace swiftlet {
namespace {

double clearance_m(const SimulatedWorld& world, const Point2& p) {
  double nearest_m = INFINITY;
  for (const WallSegment& wall : world.walls)
    nearest_m = std::min(nearest_m, distance_to_segment_m(p, wall.start, wall.end));
  return nearest_m;
}

/// One pose a second.
std::vector<Pose2> track(const SimulatedWorld& world, std::uint64_t seed) {
  const std::vector<FlightState> flight = fly(world, PilotModel{}, seed);
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < flight.size(); i += 100) poses.push_back(flight[i].T_world_body);
  return poses;
}

/// Share of the flight at places (0.3 m) to which the vehicle came back half a minute later or more, its nose
/// turned by no more than, or by at least, a right angle against the first time.
struct Revisits {
  double same_way = 0.0;
  double other_way = 0.0;
};
Revisits revisits(const std::vector<Pose2>& poses) {
  Revisits share;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    bool same_way = false;
    bool other_way = false;
    for (std::size_t j = i + 30; j < poses.size(); ++j) {
      const Pose2 step = between(poses[i], poses[j]);
      if (std::hypot(step.x_m(), step.y_m()) > 0.3) continue;
      (std::abs(step.yaw_rad()) < kPi / 2.0 ? same_way : other_way) = true;
    }
    share.same_way += same_way ? 1.0 : 0.0;
    share.other_way += other_way ? 1.0 : 0.0;
  }
  const auto count = static_cast<double>(poses.size());
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
      nearest_m = std::min(nearest_m, clearance_m(world_, state.T_world_body.position()));
    EXPECT_GT(nearest_m, 0.25) << "seed " << seed;
  }
}

TEST_P(FloorPlans, HaveNoHoleToTheOutside) {
  for (const Pose2& pose : track(world_, 1))
    for (int degree = 0; degree < 360; degree += 5)
      EXPECT_TRUE(cast_ray(world_.walls, pose.position(), radians(degree), 40.0))
          << pose.x_m() << ", " << pose.y_m() << " towards " << degree << " degrees";
}

TEST_P(FloorPlans, KeepWallsWithinReachOfTheSensors) {
  for (const Pose2& pose : track(world_, 1)) EXPECT_LT(clearance_m(world_, pose.position()), 2.5);
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
  const std::vector<Pose2> poses = track(world, 1);
  EXPECT_GT(poses.size(), 44U) << "a thousand rounds are twelve hours";
  EXPECT_LT(poses.size(), 64U);
  EXPECT_EQ(world.flight.front().position.x_m, world.flight.back().position.x_m);
  EXPECT_EQ(world.flight.front().position.y_m, world.flight.back().position.y_m);
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

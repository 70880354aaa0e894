// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/joint_refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <vector>

#include "core/backend/refinement/point_to_line_factor.hpp"
#include "core/backend/store/traversal.hpp"
#include "core/geometry/angle.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/text_room.hpp"
#include "tests/support/trajectory_error.hpp"

namespace swiftlet {
namespace {

constexpr double kPeriodS = 0.1;
constexpr int kScans = 900;

/// What is wrong with the sensors of a flight through a room.
struct Flaws {
  double age_s = 0.0;  ///< how much older the ranges are than is assumed
  double forward_scale = 1.0;
  double sideways_scale = 1.0;
  double seen_in_the_east = 1.0;  ///< of a motion over that half of the room
  double upstairs_m = 0.0;  ///< the second half is flown on another storey, its walls so far to the east
  bool tells_storeys = true;
  int arrive_together = 1;  ///< so many samples
  SensorModel sensor = SensorModel::crazyflie();
};

/// Around the middle of the room, swaying and looking about.
Pose2 true_pose(double t_s) {
  const double way = 0.2 * t_s;
  return {2.5 + 1.3 * std::cos(way) + 0.15 * std::sin(1.3 * t_s),
          2.0 + 0.9 * std::sin(way) + 0.1 * std::cos(0.9 * t_s), way + kPi / 2.0 + 0.5 * std::sin(0.7 * t_s)};
}

/// The same without ever going sideways.
Pose2 true_pose_on_wheels(double t_s) {
  const double way = 0.2 * t_s;
  return {2.5 + 1.2 * std::cos(way), 2.0 + 1.2 * std::sin(way), way + kPi / 2.0};
}

bool is_in_the_east(const Pose2& T_room_body) { return T_room_body.x_m() > 2.5; }

/// A flight as refinement meets it. The poses begin at the dead reckoning.
struct Flight {
  ScanStore scans;
  SensorModel sensor;
  std::vector<PlacedReturn> returns;
  std::vector<RelativePoseFactor<PoseIndex>> factors;
  std::vector<Pose2> T_true;  ///< when the ranges were measured, from the first one
  std::vector<Pose2> T_map_body;
};

TextRoom room_at(double x_m) {
  return {{"############", "#..........#", "#..........#", "#..........#", "#.......####", "#..........#",
           "#..........#", "#..........#", "############"},
          0.5,
          {x_m, 0.0}};
}

Flight fly(const Flaws& flaws, const std::function<Pose2(double)>& true_at) {
  const TextRoom room = room_at(0.0);
  const TextRoom upstairs = room_at(flaws.upstairs_m);
  BeamLayout beams;
  beams.count = 4;
  for (std::size_t k = 0; k < 4; ++k) beams.bearing_rad[k] = radians(90.0) * static_cast<double>(k);
  std::mt19937 random(31);
  const auto noise = [&](double sigma) { return std::normal_distribution<double>(0.0, sigma)(random); };
  Flight flight{ScanStore(beams), flaws.sensor, {}, {}, {}, {}};
  Pose2 T_odom_body;
  for (int i = 0; i < kScans; ++i) {
    const double t_s = i * kPeriodS;
    Pose2 step;
    if (i > 0) step = between(true_at(t_s - kPeriodS), true_at(t_s));
    const double seen = is_in_the_east(true_at(t_s)) ? flaws.seen_in_the_east : 1.0;
    step = Pose2(seen * step.x_m() / flaws.forward_scale + noise(0.003),
                 seen * step.y_m() / flaws.sideways_scale + noise(0.003), step.yaw_rad() + noise(0.001));
    if (i > 0) T_odom_body = T_odom_body * step;
    const Pose2 T_room_body = true_at(t_s - flaws.age_s);
    FrontendStep made;
    made.sample.measured_at = DeviceTime(from_seconds(t_s));
    made.sample.stamp = HostTime(from_seconds((i - i % flaws.arrive_together) * kPeriodS));
    made.sample.T_odom_body = made.T_dead_body = T_odom_body;
    made.sample.starts_segment = i == 0;
    made.sample.beam_count = 4;
    const bool is_upstairs = flaws.upstairs_m != 0.0 && i >= kScans / 2;
    if (is_upstairs && flaws.tells_storeys) made.sample.storey = make_id<StoreyId>(1);
    made.keyframe = make_id<KeyframeId>(static_cast<std::size_t>(i) / 5);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto range_m =
          (is_upstairs ? upstairs : room)
              .range_m(T_room_body.position(), T_room_body.yaw_rad() + beams.bearing_rad[k], 8.0);
      if (!range_m) continue;
      made.sample.distance_m[k] = static_cast<float>(*range_m + noise(0.01));
      made.sample.status[k] = RangeStatus::kHit;
    }
    const ScanId scan = flight.scans.add(made);
    for (const ScanReturn& beam : flight.scans.returns(scan))
      flight.returns.push_back({make_id<PoseIndex>(static_cast<std::size_t>(i)),
                                index_of(traversal_of(flight.scans[scan])), made.sample.storey, false,
                                flight.scans.point_body(beam)});
    flight.T_true.push_back(true_at(-flaws.age_s).inverse() * T_room_body);
    flight.T_map_body.push_back(T_odom_body);
  }
  const std::span<const StoredScan> stored = flight.scans.all().values();
  for (std::size_t i = 1; i < stored.size(); ++i)
    flight.factors.push_back({make_id<PoseIndex>(i - 1), make_id<PoseIndex>(i),
                              between(flight.T_map_body[i - 1], flight.T_map_body[i]),
                              motion_information(stored[i - 1], stored[i], flight.sensor.odometry) /
                                  flight.sensor.odometry.steps_err_together});
  return flight;
}

Status refine(Flight& flight) {
  return refine_jointly(flight.scans.all().values(), flight.sensor, flight.returns, {}, BackendTuning(),
                        flight.factors, flight.T_map_body);
}

/// From the true path, as loop closing leaves it.
Result<FloorFindings> refine_with_floor(Flight& flight) {
  flight.T_map_body.clear();
  for (const Pose2& T_room_body : flight.T_true)
    flight.T_map_body.push_back(flight.T_true.front().inverse() * T_room_body);
  return refine_jointly_with_floor(flight.scans.all().values(), flight.sensor, flight.returns, {},
                                   BackendTuning(), flight.factors, flight.T_map_body);
}

double rms_m(const Flight& flight) { return aligned_rms_error_m(flight.T_map_body, flight.T_true); }

/// Of the motions' way along one axis of the body: as corrected, over as measured.
double found_scale(const Flight& flight, const Flight& before, int axis) {
  double corrected = 0.0;
  double measured = 0.0;
  for (std::size_t i = 0; i + 1 < flight.T_true.size(); ++i) {
    corrected += std::abs(flight.factors[i].T_from_to.vector()(axis));
    measured += std::abs(before.factors[i].T_from_to.vector()(axis));
  }
  return corrected / measured;
}

TEST(JointRefinement, PutsThePathWhereTheWallsWereSeen) {
  Flight flight = fly({}, true_pose);
  const double before_m = rms_m(flight);
  ASSERT_TRUE(refine(flight));
  EXPECT_GT(before_m, 0.03);
  EXPECT_LT(rms_m(flight), 0.015);
}

TEST(JointRefinement, FindsTheScalesOfTheOdometry) {
  Flight flight = fly({.forward_scale = 1.04, .sideways_scale = 1.04}, true_pose);
  const Flight before = flight;
  ASSERT_TRUE(refine(flight));
  EXPECT_NEAR(found_scale(flight, before, 0), 1.04, 0.008);
  EXPECT_NEAR(found_scale(flight, before, 1), 1.04, 0.01);
  EXPECT_LT(rms_m(flight), 0.25 * rms_m(before));
}

void expect_age_is_found(const Flight& before) {
  Flight flight = before;
  ASSERT_TRUE(refine(flight));
  // What the vehicle turned between two scans, 40 ms earlier than by the odometry's stamps.
  double off_before = 0.0;
  double off_after = 0.0;
  for (std::size_t i = 5; i + 5 < flight.T_true.size(); ++i) {
    const double turn_rad = wrap_angle(flight.T_true[i + 1].yaw_rad() - flight.T_true[i].yaw_rad());
    off_before += std::abs(wrap_angle(before.factors[i].T_from_to.yaw_rad() - turn_rad));
    off_after += std::abs(wrap_angle(flight.factors[i].T_from_to.yaw_rad() - turn_rad));
  }
  EXPECT_LT(off_after, 0.7 * off_before);
  EXPECT_LT(rms_m(flight), 0.02);
}

TEST(JointRefinement, FindsTheAgeOfTheRanges) { expect_age_is_found(fly({.age_s = 0.04}, true_pose)); }

/// A link that stalls delivers them in bunches. When they were measured the vehicle's clock says.
TEST(JointRefinement, FindsTheAgeOfRangesThatArriveTogether) {
  expect_age_is_found(fly({.age_s = 0.04, .arrive_together = 4}, true_pose));
}

TEST(JointRefinement, FindsTheScaleOfWheels) {
  Flight flight = fly({.forward_scale = 1.04, .sensor = SensorModel::carmen_laser()}, true_pose_on_wheels);
  const Flight before = flight;
  ASSERT_TRUE(refine(flight));
  EXPECT_NEAR(found_scale(flight, before, 0), 1.04, 0.015);
}

TEST(JointRefinement, WithoutReturnsThePathStaysTheDeadReckoning) {
  Flight flight = fly({}, true_pose);
  flight.returns.clear();
  const std::vector<Pose2> before = flight.T_map_body;
  ASSERT_TRUE(refine(flight));
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(flight.T_map_body[i].x_m(), before[i].x_m(), 1e-9) << i;
    EXPECT_NEAR(flight.T_map_body[i].y_m(), before[i].y_m(), 1e-9) << i;
  }
}

TEST(JointRefinement, HeldOutReturnsHaveNoSay) {
  const auto refined = [](double shift_m) {
    Flight flight = fly({}, true_pose);
    for (std::size_t i = 0; i < flight.returns.size(); i += 10) {
      flight.returns[i].held_out = true;
      flight.returns[i].p_body.x_m += shift_m;
    }
    EXPECT_TRUE(refine(flight));
    return flight.T_map_body;
  };
  EXPECT_TRUE(same_bits(refined(0.0), refined(0.5)));
}

TEST(JointRefinement, ReturnsCanBeToldTheirPatches) {
  Flight flight = fly({}, true_pose);
  const auto solve = [&](bool is_told, std::size_t returns) {
    const auto problem = joint_problem(flight.scans.all().values(), flight.sensor, flight.returns, {},
                                       BackendTuning(), flight.factors, flight.T_map_body);
    const std::vector<DrawnReturn> drawn = problem->drawn();
    EXPECT_EQ(drawn.size(), problem->hits().size());
    WallPatches found = find_wall_patches(drawn);
    for (std::size_t k = returns; k < drawn.size(); ++k) found.patch_of[k] = WallPatches::kNone;
    if (is_told)
      problem->associate_with(found);
    else
      problem->associate();
    EXPECT_TRUE(problem->step());
    return path_of(*problem, flight.T_map_body.front());
  };
  EXPECT_TRUE(same_bits(solve(true, SIZE_MAX), solve(false, 0)));
  EXPECT_FALSE(same_bits(solve(true, flight.returns.size() / 2), solve(false, 0)));
}

TEST(JointRefinement, ARunIsRepeatedBitForBit) {
  Flight once = fly({.age_s = 0.02, .forward_scale = 1.02}, true_pose);
  Flight again = once;
  ASSERT_TRUE(refine(once));
  ASSERT_TRUE(refine(again));
  EXPECT_TRUE(same_bits(once.T_map_body, again.T_map_body));
}

TEST(JointRefinement, WhatHasNoSolutionLeavesAllAsItWas) {
  Flight flight = fly({}, true_pose);
  flight.factors[5].information(0, 0) = std::nan("");
  const Flight before = flight;
  const Status refined = refine(flight);
  ASSERT_FALSE(refined);
  EXPECT_EQ(refined.error().code, ErrorCode::kSolver);
  EXPECT_TRUE(same_bits(flight.T_map_body, before.T_map_body));
}

/// Of the steps that are a scan's way and more from where the floors meet.
double mean_scale(const Flight& flight, const FloorFindings& floor, bool in_the_east) {
  double sum = 0.0;
  int count = 0;
  for (int i = 1; i < kScans; ++i) {
    const Pose2 T_room_body = true_pose(i * kPeriodS);
    if (is_in_the_east(T_room_body) != in_the_east || std::abs(T_room_body.x_m() - 2.5) < 0.75) continue;
    sum += floor.step_scale[static_cast<std::size_t>(i)];
    ++count;
  }
  EXPECT_EQ(floor.step_scale.size(), flight.T_true.size());
  return sum / count;
}

TEST(JointRefinement, FindsTheFloorOfWhichTheFlowSensorSeesAPart) {
  Flight flight = fly({.seen_in_the_east = 0.6}, true_pose);
  const Result<FloorFindings> floor = refine_with_floor(flight);
  ASSERT_TRUE(floor);
  EXPECT_GT(floor->cost, FloorFieldTuning().min_cost);
  // By how much all motions are long is told apart from it by the priors alone.
  EXPECT_NEAR(mean_scale(flight, *floor, true) / mean_scale(flight, *floor, false), 1.0 / 0.6, 0.15);
  EXPECT_LT(rms_m(flight), 0.03);
}

TEST(JointRefinement, AnEvenFloorCostsNothing) {
  for (const double scale : {1.0, 1.04}) {
    Flight flight = fly({.forward_scale = scale, .sideways_scale = scale}, true_pose);
    const Result<FloorFindings> floor = refine_with_floor(flight);
    ASSERT_TRUE(floor);
    EXPECT_LT(floor->cost, 0.5 * FloorFieldTuning().min_cost) << scale;
  }
}

TEST(JointRefinement, WallsOfAnotherStoreyAreOtherWalls) {
  const auto error_m = [](bool tells_storeys) {
    Flaws house;
    house.upstairs_m = 0.1;
    house.tells_storeys = tells_storeys;
    Flight flight = fly(house, true_pose);
    flight.T_map_body = flight.T_true;
    EXPECT_TRUE(refine(flight));
    return rms_m(flight);
  };
  EXPECT_LT(error_m(true), 0.015);
  EXPECT_GT(error_m(false), 0.03);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/batch_refinement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "tests/support/loop_corridor.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/random_draws.hpp"
#include "tests/support/stored_run.hpp"
#include "tests/support/trajectory_error.hpp"

namespace swiftlet {
namespace {

TestVehicleModel drifting() {
  TestVehicleModel model;
  model.drift_rad_per_m = 0.004;
  model.odometry_sigma_m = 0.003;
  return model;
}

/// Four times along one side of the building.
TestVehicle to_and_fro(const TestVehicleModel& model) {
  TestVehicle vehicle = vehicle_at_start(model, 21);
  fly_along(vehicle, loop_corridor(), "baba");
  return vehicle;
}

std::vector<Pose2> dead_reckoned(const TestVehicle& vehicle) {
  std::vector<Pose2> T_odom_body;
  for (const RangeSample& sample : vehicle.samples()) T_odom_body.push_back(sample.T_odom_body);
  return T_odom_body;
}

/// As loop closing leaves a path: off in slow waves, here of up to a third of a metre.
std::vector<Pose2> in_large_waves(std::vector<Pose2> path) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double phase = 2.0 * kPi * static_cast<double>(i) / 150.0;
    path[i] =
        Pose2(path[i].x_m() + 0.15 * (1.0 - std::cos(phase)), path[i].y_m() + 0.15 * std::sin(1.3 * phase),
              path[i].yaw_rad() + 0.03 * std::sin(0.7 * phase));
  }
  return path;
}

/// Dead reckoning that is thought so many times worse than it is.
SensorModel with_odometry_noise(double factor) {
  SensorModel sensor = SensorModel::crazyflie();
  sensor.odometry.xy_m = sensor.odometry.xy_m.scaled(factor);
  sensor.odometry.yaw_rad = sensor.odometry.yaw_rad.scaled(factor);
  return sensor;
}

/// In turn, then together.
Result<RefinementReport> refine(const BatchRefinement& batch, std::vector<Pose2>& T_map_body) {
  Result<RefinementReport> report = refine_in_turn(batch, T_map_body);
  if (!report) return report;
  if (Status status = refine_together(batch, *report, T_map_body); !status) return status.error();
  return report;
}

Result<RefinementReport> refine(const TestVehicle& vehicle, std::vector<Pose2>& T_map_body,
                                const std::vector<RelativePoseFactor<ScanId>>& closures = {},
                                const SensorModel& sensor = SensorModel::crazyflie()) {
  const StoredRun run(vehicle.samples());
  return refine({.scans = run.scans(), .sensor = sensor, .closures = closures, .config = {}}, T_map_body);
}

double worst_m(const std::vector<Pose2>& estimate, const std::vector<Pose2>& truth) {
  double worst = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    worst =
        std::max(worst, std::hypot(estimate[i].x_m() - truth[i].x_m(), estimate[i].y_m() - truth[i].y_m()));
  return worst;
}

/// Twelve beams all around.
BeamLayout star() {
  BeamLayout beams;
  beams.count = 12;
  for (std::size_t i = 0; i < beams.count; ++i) beams.bearing_rad[i] = radians(30.0) * static_cast<double>(i);
  return beams;
}

/// Sixty looks at a room from here and there, three to a traversal, with dead reckoning that gives next to
/// nothing.
struct LooksAtARoom {
  ScanStore scans{star()};
  std::vector<Pose2> T_map_body;
  SensorModel sensor = with_odometry_noise(100.0);
};

/// `longer` is the number of a return that reads 0.1 m too much.
LooksAtARoom looks_at_a_room(std::size_t longer = static_cast<std::size_t>(-1)) {
  const TextRoom room({"##########", "#........#", "#........#", "#.....####", "#........#", "##########"},
                      0.5);
  std::mt19937 random(25);
  LooksAtARoom looks;
  std::size_t returns = 0;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const Pose2 T_map_body(random_in(random, 0.8, 2.7), random_in(random, 0.8, 2.2),
                           random_in(random, -kPi, kPi));
    FrontendStep step;
    step.sample.beam_count = star().count;
    step.keyframe = static_cast<KeyframeId>(i);
    step.T_dead_body = T_map_body;
    for (std::size_t beam = 0; beam < star().count; ++beam, ++returns) {
      const auto range_m =
          room.range_m(T_map_body.position(), T_map_body.yaw_rad() + star().bearing_rad[beam], 10.0);
      step.sample.distance_m[beam] = static_cast<float>(range_m.value() + (returns == longer ? 0.1 : 0.0));
    }
    looks.scans.add(step);
    looks.T_map_body.push_back(T_map_body);
  }
  return looks;
}

/// Every pose but the first a little off, each its own way.
std::vector<Pose2> shaken(const std::vector<Pose2>& path) {
  std::mt19937 random(26);
  std::vector<Pose2> T_map_body = path;
  for (std::size_t i = 1; i < T_map_body.size(); ++i)
    T_map_body[i] = T_map_body[i] * Pose2(random_in(random, -0.1, 0.1), random_in(random, -0.1, 0.1),
                                          random_in(random, -0.1, 0.1));
  return T_map_body;
}

double share_on_walls_of_any(const std::vector<RangeSample>& samples, const std::vector<Pose2>& path) {
  const StoredRun run(samples);
  const SensorModel sensor = SensorModel::crazyflie();
  return share_on_walls_of_any({.scans = run.scans(), .sensor = sensor, .config = {}}, path);
}

TEST(Refinement, KnowsABuildingFromABushWithoutASecondVisit) {
  TestVehicle vehicle = vehicle_at_start({}, 22);
  fly_along(vehicle, loop_corridor(), "b");
  std::vector<RangeSample> samples = vehicle.samples();
  EXPECT_GT(share_on_walls_of_any(samples, true_poses(vehicle)), 0.75);
  std::mt19937 random(23);
  for (RangeSample& sample : samples)
    for (std::size_t beam = 0; beam < sample.beam_count; ++beam)
      sample.distance_m[beam] = static_cast<float>(random_in(random, 0.3, 3.0));
  EXPECT_LT(share_on_walls_of_any(samples, true_poses(vehicle)), 0.3);
}

TEST(Refinement, BringsPassesThroughACorridorTogether) {
  const TestVehicle vehicle = to_and_fro(drifting());
  const std::vector<Pose2> truth = true_poses(vehicle);
  std::vector<Pose2> T_map_body = dead_reckoned(vehicle);
  const double before_m = aligned_rms_error_m(T_map_body, truth);
  const Result<RefinementReport> report = refine(vehicle, T_map_body);
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_GT(before_m, 0.15) << "there is something to correct";
  EXPECT_LT(aligned_rms_error_m(T_map_body, truth), 0.5 * before_m);
  EXPECT_TRUE(report->accepted);
  EXPECT_LT(report->held_out_after_m, 0.3 * report->held_out_before_m);
  EXPECT_TRUE(poses_near(T_map_body[0], Pose2(), 0.0, 0.0)) << "the first pose is held";
}

TEST(Refinement, SmoothsOutWhatLoopClosingLeaves) {
  const TestVehicle vehicle = to_and_fro(drifting());
  const std::vector<Pose2> truth = true_poses(vehicle);
  std::vector<Pose2> T_map_body = in_large_waves(truth);
  const double before_m = aligned_rms_error_m(T_map_body, truth);
  const Result<RefinementReport> report = refine(vehicle, T_map_body);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_LT(aligned_rms_error_m(T_map_body, truth), 0.25 * before_m);
  EXPECT_TRUE(report->accepted);
  EXPECT_LT(report->held_out_after_m, 0.15 * report->held_out_before_m);
}

TEST(Refinement, TwoRunsGiveTheSameBytes) {
  const TestVehicle vehicle = to_and_fro(drifting());
  std::vector<Pose2> one = dead_reckoned(vehicle);
  std::vector<Pose2> other = one;
  const Result<RefinementReport> report = refine(vehicle, one);
  const Result<RefinementReport> again = refine(vehicle, other);
  ASSERT_TRUE(report && again);
  EXPECT_TRUE(report->accepted);
  EXPECT_TRUE(same_bits(one, other));
  EXPECT_EQ(report->held_out_after_m, again->held_out_after_m);
}

TEST(Refinement, ATrueStartStaysNearWhereItIs) {
  TestVehicleModel precise;
  precise.range_sigma_m = 0.005;
  TestVehicle vehicle = vehicle_at_start(precise, 21);
  fly_along(vehicle, loop_corridor(), "bcdabcda");
  const std::vector<Pose2> truth = true_poses(vehicle);
  std::vector<Pose2> T_map_body = truth;
  const Result<RefinementReport> report = refine(vehicle, T_map_body);
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_TRUE(report->accepted) << "refused, the poses say nothing";
  EXPECT_LT(worst_m(T_map_body, truth), 0.12) << "in 76 m";
}

TEST(Refinement, RefusesWhatExplainsTheHeldOutReturnsWorse) {
  // The dead reckoning lies and is believed to the millimetre: it bends the poses away from the truth that
  // they start from.
  TestVehicleModel lying;
  lying.drift_rad_per_m = 0.02;
  const TestVehicle vehicle = to_and_fro(lying);
  const std::vector<Pose2> truth = true_poses(vehicle);
  std::vector<Pose2> T_map_body = truth;
  const SensorModel believed = with_odometry_noise(0.001);
  const Result<RefinementReport> report = refine(vehicle, T_map_body, {}, believed);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_GT(report->held_out_after_m, 2.0 * report->held_out_before_m);
  EXPECT_FALSE(report->accepted);
  EXPECT_TRUE(same_bits(T_map_body, truth));
}

TEST(Refinement, ASegmentMovesAsAWholeToItsWalls) {
  TestVehicle vehicle = vehicle_at_start({}, 22);
  fly_along(vehicle, loop_corridor(), "ba");
  const std::size_t second = vehicle.samples().size();
  const Point2 b = loop_corridor().place('b');
  vehicle.carry_to(loop_corridor(), Pose2(b.x_m, b.y_m, kPi));
  fly_along(vehicle, loop_corridor(), "ab");
  const std::vector<Pose2> truth = true_poses(vehicle);
  std::vector<Pose2> T_map_body = truth;
  for (std::size_t i = second; i < T_map_body.size(); ++i)
    T_map_body[i] = Pose2(0.1, -0.15, 0.01) * T_map_body[i];
  const Result<RefinementReport> report = refine(vehicle, T_map_body);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->accepted);
  // Along the corridor next to nothing holds it.
  for (std::size_t i = second; i < truth.size(); ++i) {
    EXPECT_NEAR(T_map_body[i].y_m(), truth[i].y_m(), 0.04) << i;
    EXPECT_NEAR(between(truth[i], T_map_body[i]).yaw_rad(), 0.0, 0.01) << i;
  }
}

TEST(Refinement, ClosuresHoldPassesTogetherWhereNoWallDoes) {
  // Nothing within reach of any beam.
  TestVehicle vehicle(TextRoom({"a"}, 0.5), Pose2(), drifting(), 23);
  for (const Point2& goal : {Point2{5.0, 0.0}, Point2{0.0, 0.0}, Point2{5.0, 0.0}, Point2{0.0, 0.0}})
    vehicle.fly_to(TextRoom({"a"}, 0.5), goal);
  const std::vector<Pose2> truth = true_poses(vehicle);
  const auto last = make_id<ScanId>(truth.size() - 1);
  RelativePoseFactor<ScanId> closure{ScanId{0}, last, truth.back()};
  closure.information = Eigen::Vector3d(1e6, 1e6, 1e6).asDiagonal();
  std::vector<Pose2> open = dead_reckoned(vehicle);
  std::vector<Pose2> closed = open;
  const double before_m = worst_m(open, truth);
  ASSERT_TRUE(refine(vehicle, open));
  const Result<RefinementReport> report = refine(vehicle, closed, {closure});
  ASSERT_TRUE(report);
  EXPECT_NEAR(worst_m(open, truth), before_m, 1e-9) << "nothing to pull at the poses";
  EXPECT_TRUE(poses_near(closed.back(), truth.back(), 0.002, 0.002));
  EXPECT_LT(worst_m(closed, truth), 0.6 * before_m) << "those between come along";
}

TEST(Refinement, TurnsAndShiftsEachScanOntoTheWallsOfTheOthers) {
  const LooksAtARoom looks = looks_at_a_room();
  std::vector<Pose2> T_map_body = shaken(looks.T_map_body);
  const Result<RefinementReport> report =
      refine({.scans = looks.scans, .sensor = looks.sensor, .config = {}}, T_map_body);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_TRUE(report->accepted);
  // Pair by pair: only the first scan, which is held, hangs loosely on all the others. One look may leave a
  // scan free in one direction, and is in two pairs.
  int off = 0;
  for (std::size_t i = 2; i < T_map_body.size(); ++i)
    off += poses_near(between(T_map_body[i - 1], T_map_body[i]),
                      between(looks.T_map_body[i - 1], looks.T_map_body[i]), 0.03, 0.02)
               ? 0
               : 1;
  EXPECT_LE(off, 2);
}

TEST(Refinement, ASlipCountsAsOneNotByItsSize) {
  const TestVehicle vehicle = to_and_fro(drifting());
  const std::vector<Pose2> straight = dead_reckoned(vehicle);
  std::vector<Pose2> slipped = straight;
  const Pose2 last = straight.back();
  slipped.back() = Pose2(last.x_m(), last.y_m(), last.yaw_rad() + radians(40.0));
  const auto misfit_at_start = [&](std::vector<Pose2> path) {
    const Result<RefinementReport> report = refine(vehicle, path);
    if (!report) return -1.0;
    return std::accumulate(report->misfit_at_start.begin(), report->misfit_at_start.end(), 0.0);
  };
  const BackendConfig config;
  const double returns_at_most =
      static_cast<double>(BeamLayout::multiranger().count) * config.tuning.refinement.cap_sigmas;
  const double cost = misfit_at_start(slipped) - misfit_at_start(straight);
  EXPECT_GT(cost, config.dcs_phi);
  EXPECT_LT(cost, 0.5 * 3.0 * config.dcs_phi + returns_at_most);
}

TEST(Refinement, WhereWallsCannotMovePosesDo) {
  const LooksAtARoom looks = looks_at_a_room();
  BackendConfig config;
  config.tuning.poses_and_walls.patch_turn_sigma_rad = std::nan("");
  const BatchRefinement batch{.scans = looks.scans, .sensor = looks.sensor, .config = config};
  std::vector<Pose2> T_map_body = shaken(looks.T_map_body);
  Result<RefinementReport> report = refine_in_turn(batch, T_map_body);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_TRUE(report->accepted);
  EXPECT_LT(report->held_out_after_m, 0.5 * report->held_out_before_m);
  const std::vector<Pose2> T_map_turn = T_map_body;
  const Status together = refine_together(batch, *report, T_map_body);
  ASSERT_FALSE(together);
  EXPECT_EQ(together.error().code, ErrorCode::kSolver);
  EXPECT_FALSE(report->moved_walls);
  EXPECT_TRUE(report->accepted);
  EXPECT_TRUE(same_bits(T_map_body, T_map_turn));
}

/// They share the pose of a scan that moved to the others, and flatter it.
TEST(Refinement, HeldOutReturnsJudgeWallsAndPosesOnlyWhereTheyRefusedPosesAlone) {
  const LooksAtARoom looks = looks_at_a_room();
  const BatchRefinement batch{.scans = looks.scans, .sensor = looks.sensor, .config = {}};
  std::vector<Pose2> T_map_turn = shaken(looks.T_map_body);
  Result<RefinementReport> report = refine_in_turn(batch, T_map_turn);
  ASSERT_TRUE(report && report->accepted);
  report->held_out_before_m = 0.0;  // nothing is as near
  RefinementReport refused = *report;
  refused.accepted = false;
  std::vector<Pose2> T_map_body = T_map_turn;
  ASSERT_TRUE(refine_together(batch, refused, T_map_body));
  EXPECT_FALSE(refused.moved_walls);
  EXPECT_FALSE(refused.accepted);
  EXPECT_TRUE(same_bits(T_map_body, T_map_turn));
  ASSERT_TRUE(refine_together(batch, *report, T_map_body));
  EXPECT_TRUE(report->moved_walls);
  EXPECT_FALSE(same_bits(T_map_body, T_map_turn));
}

TEST(Refinement, ATenthOfTheReturnsHasNoSay) {
  const auto refined = [](const LooksAtARoom& looks) {
    std::vector<Pose2> T_map_body = shaken(looks.T_map_body);
    const auto report = refine({.scans = looks.scans, .sensor = looks.sensor, .config = {}}, T_map_body);
    EXPECT_TRUE(report && report->accepted);
    return T_map_body;
  };
  const std::vector<Pose2> plain = refined(looks_at_a_room());
  int without_say = 0;
  for (std::size_t longer = 300; longer < 340; ++longer)
    without_say += same_bits(refined(looks_at_a_room(longer)), plain) ? 1 : 0;
  EXPECT_EQ(without_say, 4);
}

TEST(Refinement, FewerThanTwoScansStayAsTheyAre) {
  const TestVehicle vehicle = vehicle_at_start({}, 24);
  for (const std::size_t scans : {0U, 1U}) {
    const StoredRun run(std::span(vehicle.samples()).first(scans));
    std::vector<Pose2> T_map_body(scans, Pose2(1.0, 2.0, 3.0));
    const Result<RefinementReport> report =
        refine({.scans = run.scans(), .sensor = {}, .config = {}}, T_map_body);
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->accepted);
    EXPECT_TRUE(same_bits(T_map_body, std::vector<Pose2>(scans, Pose2(1.0, 2.0, 3.0))));
  }
}

TEST(Refinement, TakesAsManyRoundsAsItMay) {
  const TestVehicle vehicle = to_and_fro(drifting());
  const StoredRun run(vehicle.samples());
  const auto after = [&](int rounds, std::vector<Pose2> T_map_body) {
    BackendConfig config;
    config.refinement_iterations = rounds;
    config.tuning.refinement.wide_radius_m = config.tuning.refinement.walls.radius_m;
    const BatchRefinement batch{.scans = run.scans(), .sensor = SensorModel::crazyflie(), .config = config};
    const Result<RefinementReport> report = refine_in_turn(batch, T_map_body);
    EXPECT_TRUE(report && report->accepted);
    return T_map_body;
  };
  const std::vector<Pose2> one = after(1, dead_reckoned(vehicle));
  EXPECT_TRUE(same_bits(after(2, dead_reckoned(vehicle)), after(1, one)));
  EXPECT_FALSE(same_bits(after(2, dead_reckoned(vehicle)), one));
}

TEST(RefinementDeathTest, AScanWithoutAPoseIsABrokenPromise) {
  const TestVehicle vehicle = to_and_fro(drifting());
  std::vector<Pose2> too_few(3);
  EXPECT_DEATH((void)refine(vehicle, too_few), "broken promise.*every scan has a pose");
}

}  // namespace
}  // namespace swiftlet

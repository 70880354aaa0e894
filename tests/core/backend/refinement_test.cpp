// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "tests/support/loop_corridor.hpp"
#include "tests/support/pose_near.hpp"
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

/// Truth, with the first pose as origin as in dead reckoning.
std::vector<Pose2> true_poses(const TestVehicle& vehicle) {
  std::vector<Pose2> T_map_body;
  for (const Pose2& T_world_body : vehicle.T_world_body())
    T_map_body.push_back(between(vehicle.T_world_body()[0], T_world_body));
  return T_map_body;
}
std::vector<Pose2> dead_reckoned(const TestVehicle& vehicle) {
  std::vector<Pose2> T_odom_body;
  for (const RangeSample& sample : vehicle.samples()) T_odom_body.push_back(sample.T_odom_body);
  return T_odom_body;
}

/// As loop closing leaves a path: off in slow waves, here of up to a third of a metre.
std::vector<Pose2> in_waves(std::vector<Pose2> path) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double phase = 2.0 * kPi * static_cast<double>(i) / 150.0;
    path[i] =
        Pose2(path[i].x_m() + 0.15 * (1.0 - std::cos(phase)), path[i].y_m() + 0.15 * std::sin(1.3 * phase),
              path[i].yaw_rad() + 0.03 * std::sin(0.7 * phase));
  }
  return path;
}

Result<RefinementReport> refine(const TestVehicle& vehicle, std::vector<Pose2>& T_map_body,
                                const std::vector<PoseConstraint>& closures = {},
                                const SensorModel& sensor = SensorModel::crazyflie()) {
  const StoredRun run(vehicle.samples());
  return refine_scan_poses(run.scans(), sensor, closures, {}, T_map_body);
}

double worst_m(const std::vector<Pose2>& estimate, const std::vector<Pose2>& truth) {
  double worst = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    worst =
        std::max(worst, std::hypot(estimate[i].x_m() - truth[i].x_m(), estimate[i].y_m() - truth[i].y_m()));
  return worst;
}

bool same_bits(const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      if (std::bit_cast<std::uint64_t>(a[i].vector()[k]) != std::bit_cast<std::uint64_t>(b[i].vector()[k]))
        return false;
    }
  }
  return a.size() == b.size();
}

TEST(Refinement, BringsPassesThroughACorridorTogether) {
  const TestVehicle vehicle = to_and_fro(drifting());
  const std::vector<Pose2> truth = true_poses(vehicle);
  std::vector<Pose2> T = dead_reckoned(vehicle);
  const double before_m = aligned_rms_error_m(T, truth);
  const Result<RefinementReport> report = refine(vehicle, T);
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_GT(before_m, 0.15) << "there is something to correct";
  EXPECT_LT(aligned_rms_error_m(T, truth), 0.5 * before_m);
  EXPECT_TRUE(report->accepted);
  EXPECT_LT(report->held_back_after_m, 0.3 * report->held_back_before_m);
  EXPECT_TRUE(poses_near(T[0], Pose2(), 0.0, 0.0)) << "the first pose is held";
}

TEST(Refinement, SmoothsOutWhatLoopClosingLeaves) {
  const TestVehicle vehicle = to_and_fro(drifting());
  const std::vector<Pose2> truth = true_poses(vehicle);
  std::vector<Pose2> T = in_waves(truth);
  const double before_m = aligned_rms_error_m(T, truth);
  const Result<RefinementReport> report = refine(vehicle, T);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_LT(aligned_rms_error_m(T, truth), 0.25 * before_m);
  EXPECT_TRUE(report->accepted);
  EXPECT_LT(report->held_back_after_m, 0.15 * report->held_back_before_m);
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
  EXPECT_EQ(report->iterations, again->iterations);
  EXPECT_EQ(report->held_back_after_m, again->held_back_after_m);
}

TEST(Refinement, ATrueStartStaysNearWhereItIs) {
  TestVehicle vehicle = vehicle_at_start({}, 21);
  fly_along(vehicle, loop_corridor(), "bcdabcda");
  const std::vector<Pose2> truth = true_poses(vehicle);
  std::vector<Pose2> T = truth;
  const Result<RefinementReport> report = refine(vehicle, T);
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_TRUE(report->accepted) << "refused, the poses say nothing";
  EXPECT_LT(worst_m(T, truth), 0.06) << "in 76 m";
}

TEST(Refinement, RefusesWhatExplainsTheHeldBackReturnsWorse) {
  // The dead reckoning lies and is believed to the millimetre: it bends the poses away from the truth that
  // they start from.
  TestVehicleModel lying;
  lying.drift_rad_per_m = 0.02;
  const TestVehicle vehicle = to_and_fro(lying);
  const std::vector<Pose2> truth = true_poses(vehicle);
  std::vector<Pose2> T = truth;
  SensorModel believed = SensorModel::crazyflie();
  believed.odometry = believed.odometry.scaled(0.001);
  const Result<RefinementReport> report = refine(vehicle, T, {}, believed);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_GT(report->held_back_after_m, 2.0 * report->held_back_before_m);
  EXPECT_FALSE(report->accepted);
  EXPECT_TRUE(same_bits(T, truth));
}

TEST(Refinement, ASegmentMovesAsAWholeToItsWalls) {
  TestVehicle vehicle = vehicle_at_start({}, 22);
  fly_along(vehicle, loop_corridor(), "ba");
  const std::size_t second = vehicle.samples().size();
  const Point2 b = loop_corridor().place('b');
  vehicle.carry_to(loop_corridor(), Pose2(b.x_m, b.y_m, kPi));
  fly_along(vehicle, loop_corridor(), "ab");
  const std::vector<Pose2> truth = true_poses(vehicle);
  std::vector<Pose2> T = truth;
  for (std::size_t i = second; i < T.size(); ++i) T[i] = Pose2(0.1, -0.15, 0.01) * T[i];
  const double before_m = worst_m(T, truth);
  const Result<RefinementReport> report = refine(vehicle, T);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->accepted);
  EXPECT_LT(worst_m(T, truth), 0.4 * before_m);
}

TEST(Refinement, ClosuresHoldPassesTogetherWhereNoWallDoes) {
  // Nothing within reach of any beam.
  TestVehicle vehicle(TextRoom({"a"}, 0.5), Pose2(), drifting(), 23);
  for (const Point2& goal : {Point2{5.0, 0.0}, Point2{0.0, 0.0}, Point2{5.0, 0.0}, Point2{0.0, 0.0}})
    vehicle.fly_to(TextRoom({"a"}, 0.5), goal);
  const std::vector<Pose2> truth = true_poses(vehicle);
  const auto last = static_cast<KeyframeId>(truth.size() - 1);
  PoseConstraint closure{KeyframeId{0}, last, truth.back()};
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

TEST(Refinement, FewerThanTwoScansStayAsTheyAre) {
  const TestVehicle vehicle = vehicle_at_start({}, 24);
  for (const std::size_t scans : {0U, 1U}) {
    const StoredRun run(std::span(vehicle.samples()).first(scans));
    std::vector<Pose2> T(scans, Pose2(1.0, 2.0, 3.0));
    const Result<RefinementReport> report = refine_scan_poses(run.scans(), {}, {}, {}, T);
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->accepted);
    EXPECT_EQ(report->iterations, 0);
    EXPECT_TRUE(same_bits(T, std::vector<Pose2>(scans, Pose2(1.0, 2.0, 3.0))));
  }
}

TEST(Refinement, TakesNoMoreRoundsThanItMay) {
  const TestVehicle vehicle = to_and_fro(drifting());
  const StoredRun run(vehicle.samples());
  BackendConfig config;
  config.refinement_iterations = 2;
  std::vector<Pose2> T = dead_reckoned(vehicle);
  const Result<RefinementReport> report =
      refine_scan_poses(run.scans(), SensorModel::crazyflie(), {}, config, T);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->iterations, 2);
}

TEST(RefinementDeathTest, AScanWithoutAPoseIsABrokenPromise) {
  const TestVehicle vehicle = to_and_fro(drifting());
  std::vector<Pose2> too_few(3);
  EXPECT_DEATH((void)refine(vehicle, too_few), "broken promise.*every scan has a pose");
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/window_refinement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/backend/refinement/point_to_line_factor.hpp"
#include "core/backend/store/traversal.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/stored_run.hpp"

namespace swiftlet {
namespace {

/// There and back along one side of the building, with a dead reckoning that does not err.
class ThereAndBack {
 public:
  [[nodiscard]] const ScanStore& scans() const { return run_.scans(); }
  /// Truth, in the frame of the first pose.
  [[nodiscard]] Pose2 truth(ScanId scan) const { return vehicle_.samples()[index_of(scan)].T_odom_body; }
  /// Some of the way back.
  [[nodiscard]] ScanRange window() const {
    const ScanId end = scans().all().end_id();
    return {end - 150, end - 30};
  }
  /// All there is with the scan before the window, at the truth.
  [[nodiscard]] WindowPoses true_poses() const {
    WindowPoses poses;
    poses.scans = {window().first - 1, window().end};
    for (ScanId i = poses.scans.first; i < poses.scans.end; ++i) poses.T_map_body.push_back(truth(i));
    poses.T_map_graph = poses.T_local_body = poses.T_map_body;
    return poses;
  }
  /// What the way there drew.
  [[nodiscard]] std::vector<TraversalPoint> way_there() const {
    std::vector<TraversalPoint> points;
    for (const auto& [id, scan] : scans().all()) {
      if (index_of(id) >= scans().size() / 2) break;
      for (const ScanReturn& beam : scans().returns(scan))
        if (beam.is_hit)
          points.push_back({truth(id) * scans().point_body(beam), index_of(traversal_of(scan))});
    }
    return points;
  }

 private:
  static TestVehicle flown() {
    TestVehicle vehicle = vehicle_at_start({}, 51);
    fly_along(vehicle, loop_corridor(), "ba");
    return vehicle;
  }
  TestVehicle vehicle_ = flown();
  StoredRun run_{vehicle_.samples()};
};

const ThereAndBack& flight() {
  static const ThereAndBack kFlight;
  return kFlight;
}

void shift_window(std::vector<Pose2>& T_map_body, const Pose2& shift) {
  for (std::size_t i = 1; i < T_map_body.size(); ++i) T_map_body[i] = shift * T_map_body[i];
}

double worst_m(const WindowPoses& poses) {
  double worst = 0.0;
  for (std::size_t i = 0; i < poses.T_map_body.size(); ++i) {
    const Pose2 off =
        between(flight().truth(poses.scans.first + static_cast<std::uint32_t>(i)), poses.T_map_body[i]);
    worst = std::max(worst, std::hypot(off.x_m(), off.y_m()));
  }
  return worst;
}

const OdometryNoise kNoise = SensorModel::crazyflie().odometry;

TEST(WindowRefinement, BringsAWindowToTheWallsOfAnEarlierPass) {
  WindowPoses poses = flight().true_poses();
  shift_window(poses.T_map_body, Pose2(0.03, -0.12, 0.005));
  poses.T_map_graph = poses.T_map_body;
  const double before_m = worst_m(poses);
  WindowRefinement refinement(flight().scans(), kNoise);
  for (int i = 0; i < 4; ++i) {
    const Result<WindowReport> report = refinement.refine(flight().window(), flight().way_there(), poses);
    ASSERT_TRUE(report);
    if (i > 0) continue;
    EXPECT_TRUE(report->accepted);
    EXPECT_LT(report->held_out_after_m, 0.8 * report->held_out_before_m);
  }
  EXPECT_GT(before_m, 0.1);
  EXPECT_LT(worst_m(poses), 0.05);
}

TEST(WindowRefinement, TheScanBeforeStays) {
  WindowPoses poses = flight().true_poses();
  shift_window(poses.T_map_body, Pose2(0.0, 0.1, 0.0));
  const WindowPoses start = poses;
  WindowRefinement refinement(flight().scans(), kNoise);
  const Result<WindowReport> report = refinement.refine(flight().window(), flight().way_there(), poses);
  ASSERT_TRUE(report && report->accepted);
  EXPECT_TRUE(poses_near(poses.T_map_body.front(), start.T_map_body.front(), 0.0, 0.0));
  for (std::size_t i = 1; i < poses.T_map_body.size(); ++i)
    EXPECT_FALSE(poses_near(poses.T_map_body[i], start.T_map_body[i], 1e-6, 1e-6)) << i;
}

TEST(WindowRefinement, ThePathHoldsTheWindowToTheScanBefore) {
  // No walls but the window's own: only the path holds it.
  WindowPoses poses = flight().true_poses();
  shift_window(poses.T_map_body, Pose2(0.0, 0.1, 0.0));
  poses.T_map_graph = poses.T_map_body;
  const double before_m = worst_m(poses);
  WindowRefinement refinement(flight().scans(), kNoise);
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(refinement.refine(flight().window(), {}, poses));
  EXPECT_LT(std::abs(between(flight().truth(poses.scans.first + 1), poses.T_map_body[1]).y_m()), 0.02);
  EXPECT_LT(worst_m(poses), before_m);
}

TEST(WindowRefinement, WhatNoWallHoldsGoesBackToTheGraph) {
  TestVehicle vehicle(TextRoom({"a"}, 0.5), Pose2(), {}, 52);  // nothing within reach of any beam
  vehicle.fly_to(TextRoom({"a"}, 0.5), {20.0, 0.0});
  const StoredRun run(vehicle.samples());
  WindowPoses poses;
  for (const RangeSample& sample : vehicle.samples()) poses.T_map_graph.push_back(sample.T_odom_body);
  poses.T_local_body = poses.T_map_graph;
  poses.T_map_body = poses.T_map_graph;
  for (Pose2& T : poses.T_map_body) T = Pose2(0.2, 0.1, 0.0) * T;
  WindowRefinement refinement(run.scans(), kNoise);
  const ScanRange window{ScanId{}, run.scans().all().end_id()};
  poses.scans = window;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(refinement.refine(window, {}, poses));
  EXPECT_TRUE(poses_near(poses.T_map_body.front(), Pose2(0.2, 0.1, 0.0), 0.0, 0.0)) << "this one stays";
  EXPECT_TRUE(poses_near(poses.T_map_body.back(), poses.T_map_graph.back(), 0.03, 0.01));
}

TEST(WindowRefinement, RefusesWhatExplainsTheHeldOutReturnsWorse) {
  // The path lies and is believed to the micrometre: it bends the window away from the truth it starts from.
  WindowPoses poses = flight().true_poses();
  for (std::size_t i = 0; i < poses.T_local_body.size(); ++i)
    poses.T_local_body[i] = Pose2(0.0, 0.0, 0.003 * static_cast<double>(i)) * poses.T_local_body[i];
  OdometryNoise believed = kNoise;
  believed.xy_m = kNoise.xy_m.scaled(0.001);
  believed.yaw_rad = kNoise.yaw_rad.scaled(0.001);
  const WindowPoses start = poses;
  WindowRefinement refinement(flight().scans(), believed);
  const Result<WindowReport> report = refinement.refine(flight().window(), flight().way_there(), poses);
  ASSERT_TRUE(report);
  EXPECT_GT(report->held_out_after_m, 1.5 * report->held_out_before_m);
  EXPECT_FALSE(report->accepted);
  for (std::size_t i = 0; i < poses.T_map_body.size(); ++i)
    EXPECT_TRUE(poses_near(poses.T_map_body[i], start.T_map_body[i], 0.0, 0.0));
}

TEST(WindowRefinement, OfEachBeamATenthOfTheScansIsHeldOut) {
  for (std::uint8_t beam = 0; beam < kMaxBeams; ++beam) {
    int held_out = 0;
    for (std::uint32_t scan = 7; scan < 107; ++scan)
      held_out += is_held_out(make_id<ScanId>(scan), beam) ? 1 : 0;
    EXPECT_EQ(held_out, 10) << int{beam};
  }
}

TEST(WindowRefinement, ABeamInTurnIsHeldOut) {
  for (std::uint32_t scan = 0; scan < 30; ++scan) {
    int held_out = 0;
    for (std::uint8_t beam = 0; beam < 10; ++beam)
      held_out += is_held_out(make_id<ScanId>(scan), beam) ? 1 : 0;
    EXPECT_EQ(held_out, 1) << scan;
  }
}

TEST(WindowRefinement, ThinsTheReturnsOfManyBeams) {
  BeamLayout beams;
  beams.count = 16;
  for (std::size_t i = 0; i < beams.count; ++i) beams.bearing_rad[i] = 0.3 * static_cast<double>(i);
  ScanStore scans(beams);
  WindowPoses poses;
  for (std::uint32_t i = 0; i < 300; ++i) {
    FrontendStep step;
    step.sample.beam_count = beams.count;
    for (std::size_t beam = 0; beam < beams.count; ++beam) step.sample.distance_m[beam] = 1.0F;
    step.keyframe = static_cast<KeyframeId>(i / 10);
    scans.add(step);
    poses.T_map_body.emplace_back();
  }
  poses.scans = {ScanId{}, scans.all().end_id()};
  poses.T_map_graph = poses.T_local_body = poses.T_map_body;
  WindowRefinement refinement(scans, kNoise);
  const Result<WindowReport> report = refinement.refine(poses.scans, {}, poses);
  ASSERT_TRUE(report);
  EXPECT_LE(report->returns, RefinementTuning{}.max_window_returns);
  EXPECT_GT(report->returns, RefinementTuning{}.max_window_returns / 3);
}

TEST(WindowRefinement, TheFirstScanOfARunAloneHasNothingToDo) {
  const ScanRange first{ScanId{0}, ScanId{1}};
  WindowPoses poses{first, {Pose2()}, {Pose2()}, {Pose2()}};
  WindowRefinement refinement(flight().scans(), kNoise);
  const Result<WindowReport> report = refinement.refine(first, {}, poses);
  ASSERT_TRUE(report);
  EXPECT_FALSE(report->accepted);
}

}  // namespace
}  // namespace swiftlet

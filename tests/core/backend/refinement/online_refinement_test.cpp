// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/online_refinement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/dead_reckoning_frontend.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/pose_near.hpp"

namespace swiftlet {
namespace {

TestVehicle flown(const std::string& places, const TestVehicleModel& model = {}) {
  TestVehicle vehicle = vehicle_at_start(model, 61);
  fly_along(vehicle, loop_corridor(), places);
  return vehicle;
}

/// Where a graph puts a keyframe that the frontend has at `T_local_keyframe`.
using Graph = std::function<Pose2(KeyframeId, const Pose2& T_local_keyframe)>;
Pose2 as_the_frontend(KeyframeId /*id*/, const Pose2& T_local_keyframe) { return T_local_keyframe; }

/// A flight, refined as it goes.
struct LiveRun {
  ScanStore scans{BeamLayout::multiranger()};
  KeyframeChain chain{scans};
  OnlineRefinement live{scans, chain, SensorModel::crazyflie()};
  DeadReckoningFrontend frontend;
  KeyframePoses T_local;
  KeyframePoses T_graph;
  std::vector<ScanRange> moved;       // by each step
  std::vector<WindowReport> windows;  // of each step

  void add(const RangeSample& sample, const Graph& graph) {
    const FrontendStep step = frontend.process(sample);
    const ScanId scan = scans.add(step);
    live.add_scan();
    if (!step.has_keyframe) return;
    chain.add(scan);
    T_local.push_back(step.T_local_body);
    T_graph.push_back(graph(step.keyframe, step.T_local_body));
    refine();
  }
  void refine() {
    const Result<ScanRange> range = live.step(T_graph, T_local);
    ASSERT_TRUE(range) << range.error().message;
    moved.push_back(*range);
    windows.push_back(live.last_window());
  }
  [[nodiscard]] Pose2 T_map_body(ScanId scan) const {
    return live.refined(scan, chain.T_w_body(scan, T_graph));
  }
};

std::unique_ptr<LiveRun> refined(const TestVehicle& vehicle, const Graph& graph = as_the_frontend) {
  auto run = std::make_unique<LiveRun>();
  for (const RangeSample& sample : vehicle.samples()) run->add(sample, graph);
  return run;
}

/// From this keyframe on the graph is off, as after a closure that was not exact.
Graph off_from(std::uint32_t keyframe, const Pose2& T_off) {
  return [=](KeyframeId id, const Pose2& T_local_keyframe) {
    return index_of(id) >= keyframe ? T_off * T_local_keyframe : T_local_keyframe;
  };
}

TEST(OnlineRefinement, TheNewestPoseFindsToTheWallsOfAnEarlierPass) {
  // The dead reckoning does not err, hence is the truth; the second time along, the graph lies 15 cm off.
  const TestVehicle vehicle = flown("baba");
  const Pose2 T_off(0.05, 0.14, 0.01);
  const auto run = refined(vehicle, off_from(60, T_off));
  const ScanId newest = run->scans.all().last_id();
  const Pose2& truth = vehicle.samples()[index_of(newest)].T_odom_body;
  EXPECT_FALSE(poses_near(run->chain.T_w_body(newest, run->T_graph), truth, 0.13, 1.0));
  EXPECT_TRUE(poses_near(run->T_map_body(newest), truth, 0.06, 0.02));
  EXPECT_GT(run->live.windows_refined(), 30U);
}

TEST(OnlineRefinement, OffsetsAreCarriedAlongWhenTheGraphMoves) {
  const TestVehicle vehicle = flown("baba");
  const auto run = refined(vehicle, off_from(60, Pose2(0.05, 0.14, 0.01)));
  std::vector<Pose2> before;
  for (ScanId i{}; i < run->scans.all().end_id(); ++i) before.push_back(run->T_map_body(i));
  const Pose2 T_moved(7.0, -3.0, 1.0);
  for (Pose2& T : run->T_graph.values()) T = T_moved * T;
  run->live.follow(run->T_graph);
  for (ScanId i{}; i < run->scans.all().end_id(); ++i)
    ASSERT_TRUE(poses_near(run->T_map_body(i), T_moved * before[index_of(i)], 1e-9, 1e-9)) << index_of(i);
}

TEST(OnlineRefinement, WallsAreFoundWhereTheGraphMovedThem) {
  const auto run = refined(flown("baba"));
  const auto points_of_four_steps = [&] {
    std::size_t points = 0;
    for (int i = 0; i < 4; ++i) {
      run->refine();
      points += run->windows.back().points;
    }
    return points;
  };
  const std::size_t before = points_of_four_steps();
  const Pose2 T_moved(37.0, -3.0, 1.0);
  for (Pose2& T : run->T_graph.values()) T = T_moved * T;
  run->live.follow(run->T_graph);
  EXPECT_GT(points_of_four_steps(), before - before / 10);
}

TEST(OnlineRefinement, TwoRunsGiveTheSameBytes) {
  TestVehicleModel drifting;
  drifting.drift_rad_per_m = 0.004;
  const TestVehicle vehicle = flown("baba", drifting);
  const auto one = refined(vehicle);
  const auto other = refined(vehicle);
  EXPECT_GT(one->live.windows_refined(), 0U);
  for (ScanId i{}; i < one->scans.all().end_id(); ++i) {
    for (int k = 0; k < 3; ++k) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(one->T_map_body(i).vector()[k]),
                std::bit_cast<std::uint64_t>(other->T_map_body(i).vector()[k]))
          << index_of(i);
    }
  }
}

TEST(OnlineRefinement, AStepTakesNoMoreHoweverLongTheRunAndHoweverOftenAPlaceWasSeen) {
  const auto run = refined(flown("babababababababababa"));
  std::size_t max_points_of_middle = 0;
  std::size_t max_points_of_end = 0;
  const std::size_t steps = run->windows.size();
  for (std::size_t i = 0; i < steps; ++i) {
    EXPECT_LE(run->scans.all().count(run->moved[i]), OnlineRefinementTuning().max_window_scans);
    EXPECT_LE(run->windows[i].returns, RefinementTuning{}.max_window_returns);
    EXPECT_LE(run->windows[i].points,
              TraversalIndexTuning().max_traversals_nearby * TraversalIndexTuning().max_points_per_traversal +
                  RefinementTuning{}.max_window_returns);
    if (i > steps / 3 && i <= 2 * steps / 3)
      max_points_of_middle = std::max(max_points_of_middle, run->windows[i].points);
    if (i > 2 * steps / 3) max_points_of_end = std::max(max_points_of_end, run->windows[i].points);
  }
  EXPECT_GT(max_points_of_middle, 1000U);
  EXPECT_LT(max_points_of_end, 1.2 * static_cast<double>(max_points_of_middle));
}

TEST(OnlineRefinement, ALongHoverIsBoundedToo) {
  const TestVehicle vehicle = flown("b");
  auto run = std::make_unique<LiveRun>();
  for (const RangeSample& sample : vehicle.samples()) run->add(sample, as_the_frontend);
  for (int i = 0; i < 2000; ++i) run->add(vehicle.samples().back(), as_the_frontend);
  run->refine();
  run->refine();
  for (const ScanRange& moved : run->moved)
    EXPECT_LE(run->scans.all().count(moved), OnlineRefinementTuning().max_window_scans);
  EXPECT_LE(run->windows.back().returns, RefinementTuning{}.max_window_returns);
}

TEST(OnlineRefinement, OffsetsThatAreTakenReachToTheNewestScan) {
  const auto run = refined(flown("baba"));
  const ScanRange taken{make_id<ScanId>(100), make_id<ScanId>(200)};
  std::vector<Pose2> before;
  for (ScanId i{}; i < run->scans.all().end_id(); ++i) before.push_back(run->live.refined(i, Pose2()));
  std::vector<Pose2> offsets;
  offsets.reserve(100);
  for (int i = 0; i < 100; ++i) offsets.emplace_back(0.001 * i, 0.1, 0.02);
  run->live.take_offsets(taken, offsets, run->T_graph);
  for (ScanId i{}; i < run->scans.all().end_id(); ++i) {
    const Pose2 expected =
        i < taken.first ? before[index_of(i)] : offsets[std::min<std::size_t>(index_of(i) - 100, 99)];
    ASSERT_TRUE(poses_near(run->live.refined(i, Pose2()), expected, 0.0, 0.0)) << index_of(i);
  }
}

TEST(OnlineRefinement, OffsetsThatAreTakenReachNoScanThatBeginsElsewhere) {
  for (const bool ran_on : {false, true}) {
    const auto run = refined(flown("ba"));
    const ScanId begins = run->scans.all().end_id();
    FrontendStep step;
    step.sample.starts_segment = true;
    step.sample.odometry_ran_on = ran_on;
    run->scans.add(step);
    run->live.add_scan();
    const Pose2 before = run->live.refined(begins, Pose2());
    const std::vector<Pose2> offsets(50, Pose2(0.3, 0.1, 0.02));
    run->live.take_offsets({ScanId{}, make_id<ScanId>(50)}, offsets, run->T_graph);
    EXPECT_TRUE(poses_near(run->live.refined(make_id<ScanId>(index_of(begins) - 1), Pose2()), offsets.back(),
                           0.0, 0.0));
    EXPECT_TRUE(poses_near(run->live.refined(begins, Pose2()), ran_on ? offsets.back() : before, 0.0, 0.0));
  }
}

TEST(OnlineRefinement, WallsAreFoundWhereOffsetsThatWereTakenPutThem) {
  // All scans move, by their offsets alone; the walls that they see move with them.
  const auto run = refined(flown("baba"));
  run->refine();
  const std::size_t before = run->windows.back().points;
  const Pose2 T_moved(37.0, -3.0, 1.0);
  std::vector<Pose2> offsets;
  for (ScanId i{}; i < run->scans.all().end_id(); ++i) {
    const Pose2 T_graph = run->chain.T_w_body(i, run->T_graph);
    offsets.push_back(between(T_graph, T_moved * T_graph));
  }
  run->live.take_offsets({ScanId{}, run->scans.all().end_id()}, offsets, run->T_graph);
  run->refine();
  EXPECT_GT(run->windows.back().points, before - before / 10);
}

TEST(OnlineRefinement, NewScansStartWithTheNewestOffsetUnlessTheyAreElsewhere) {
  const TestVehicle vehicle = flown("baba");
  const auto run = refined(vehicle, off_from(60, Pose2(0.05, 0.14, 0.01)));
  const ScanId newest = run->scans.all().last_id();
  const Pose2 T_graph_refined = run->live.refined(newest, Pose2());
  EXPECT_FALSE(poses_near(T_graph_refined, Pose2(), 0.05, 1.0));
  FrontendStep step;
  run->scans.add(step);
  run->live.add_scan();
  EXPECT_TRUE(poses_near(run->live.refined(newest + 1, Pose2()), T_graph_refined, 0.0, 0.0));
  step.sample.starts_segment = true;
  step.sample.odometry_ran_on = true;
  run->scans.add(step);
  run->live.add_scan();
  EXPECT_TRUE(poses_near(run->live.refined(newest + 2, Pose2()), T_graph_refined, 0.0, 0.0));
  step.sample.odometry_ran_on = false;
  run->scans.add(step);
  run->live.add_scan();
  EXPECT_TRUE(poses_near(run->live.refined(newest + 3, Pose2()), Pose2(), 0.0, 0.0));
}

}  // namespace
}  // namespace swiftlet

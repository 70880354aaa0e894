// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/run_refinement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/loop_corridor.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/stored_run.hpp"
#include "tests/support/trajectory_error.hpp"

namespace swiftlet {
namespace {

/// Straight, 2 m wide and without a nook: each stretch of it looks like all the others.
TextRoom straight_corridor() {
  const std::string wall(60, '#');
  return {{wall, "#" + std::string(58, '.') + "#", "#..a" + std::string(52, '.') + "b..#",
           "#" + std::string(58, '.') + "#", wall},
          0.5};
}

/// Once along it, 26 m, with perfect odometry.
TestVehicle along_the_corridor() {
  const TextRoom room = straight_corridor();
  TestVehicle vehicle(room, Pose2(room.place('a').x_m, room.place('a').y_m, 0.0), {}, 71);
  vehicle.fly_to(room, room.place('b'));
  return vehicle;
}

/// Twice round the block.
TestVehicle two_laps_that_drift(double drift_rad_per_m) {
  TestVehicleModel drifting;
  drifting.drift_rad_per_m = drift_rad_per_m;
  TestVehicle vehicle = vehicle_at_start(drifting, 72);
  fly_along(vehicle, loop_corridor(), "bcdabcda");
  return vehicle;
}

/// The odometry drifts so far that without loops its map is several metres off.
const TestVehicle& two_laps() {
  static const TestVehicle kVehicle = two_laps_that_drift(0.02);
  return kVehicle;
}

std::vector<Pose2> odometry(const TestVehicle& vehicle) {
  std::vector<Pose2> T_odom_body;
  for (const RangeSample& sample : vehicle.samples()) T_odom_body.push_back(sample.T_odom_body);
  return T_odom_body;
}

/// The odometry with a yaw error that grows with the way. Where it restarted nothing has moved.
std::vector<Pose2> bent(const TestVehicle& vehicle, double rad_per_m) {
  const std::vector<RangeSample>& samples = vehicle.samples();
  std::vector<Pose2> T{Pose2()};
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Pose2 step = between(samples[i - 1].T_odom_body, samples[i].T_odom_body);
    const Pose2 turn(0.0, 0.0, rad_per_m * std::hypot(step.x_m(), step.y_m()));
    T.push_back(samples[i].starts_segment ? T.back() : T.back() * step * turn);
  }
  return T;
}

struct FinalMap {
  std::vector<Pose2> T_map_body;
  RefinementCounters counters;
};

/// The map of a run whose pose graph has put the keyframes on this path.
FinalMap final_map(const StoredRun& run, const std::vector<Pose2>& T_graph_body,
                   std::span<const RelativePoseFactor<KeyframeId>> closures = {},
                   const BackendConfig& config = {}, const SensorModel& sensor = SensorModel::crazyflie(),
                   const MapAgain& map_again = {},
                   std::span<const RelativePoseFactor<KeyframeId>> doubted = {}) {
  PoseGraph graph;
  for (const auto& [keyframe, scan] : run.chain().all())
    graph.T_map_keyframe.push_back(T_graph_body[index_of(scan)]);
  for (const RelativePoseFactor<KeyframeId>& closure : closures) graph.factors.push_back(closure);
  for (const RelativePoseFactor<KeyframeId>& motion : doubted)
    graph.doubted.push_back(graph.factors.push_back(motion));
  RunRefinement refinement(config, sensor, run.scans(), run.chain());
  for (std::size_t i = 0; i < run.scans().size(); ++i) refinement.add_scan();
  refinement.refine_all(graph, run.T_local_keyframe(), map_again);
  FinalMap map;
  for (const auto& [scan, stored] : run.scans().all())
    map.T_map_body.push_back(refinement.T_map_body(scan, graph.T_map_keyframe));
  map.counters = refinement.counters();
  return map;
}

/// Root mean square distance over the way: what the a-priori odds look at.
double apart_over_way(const std::vector<Pose2>& a, const std::vector<Pose2>& b, const StoredRun& run) {
  double sum_m2 = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum_m2 += std::pow(a[i].x_m() - b[i].x_m(), 2) + std::pow(a[i].y_m() - b[i].y_m(), 2);
  return std::sqrt(sum_m2 / static_cast<double>(a.size())) / run.scans().all().values().back().path_m;
}

/// As loop closing leaves a path: off in slow waves of a few centimetres.
std::vector<Pose2> in_small_waves(std::vector<Pose2> path) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double phase = 2.0 * kPi * static_cast<double>(i) / 150.0;
    path[i] = path[i] * Pose2(0.05 * std::sin(phase), 0.05 * std::sin(1.3 * phase), 0.0);
  }
  return path;
}

TEST(RunRefinement, TheRangesPayForACorrectionThatDriftAloneMakesUnlikely) {
  const StoredRun run(two_laps().samples());
  const std::vector<Pose2> truth = true_poses(two_laps());
  ASSERT_GT(apart_over_way(odometry(two_laps()), truth, run), 2.0 * RefinementTuning().median_drift);
  const FinalMap map = final_map(run, in_small_waves(truth));
  EXPECT_EQ(map.counters.map_source, MapSource::kPoseGraph);
  EXPECT_LT(aligned_rms_error_m(map.T_map_body, truth), 0.3);
}

/// Once along three sides of the block: no wall is met again.
TEST(RunRefinement, BetweenWallsACorrectionNeedsNoSecondVisit) {
  TestVehicleModel drifting;
  drifting.drift_rad_per_m = 0.005;
  TestVehicle vehicle = vehicle_at_start(drifting, 74);
  fly_along(vehicle, loop_corridor(), "bcd");
  const StoredRun run(vehicle.samples());
  const std::vector<Pose2> truth = true_poses(vehicle);
  ASSERT_LT(apart_over_way(odometry(vehicle), truth, run), RefinementTuning().median_drift);
  const FinalMap map = final_map(run, in_small_waves(truth));
  EXPECT_EQ(map.counters.map_source, MapSource::kPoseGraph);
  EXPECT_LT(aligned_rms_error_m(map.T_map_body, truth), 0.5 * aligned_rms_error_m(odometry(vehicle), truth));
}

TEST(RunRefinement, WhereNoWallContradictsTheOdometryItIsTheMapAsReported) {
  const TestVehicle vehicle = along_the_corridor();
  const std::vector<Pose2> T_wound_up = bent(vehicle, 0.02);
  const StoredRun run(vehicle.samples(), T_wound_up);
  ASSERT_GT(apart_over_way(T_wound_up, odometry(vehicle), run), 2.0 * RefinementTuning().median_drift);
  const Pose2 T_map_first(3.0, -2.0, 0.7);
  std::vector<Pose2> T_graph_body = T_wound_up;
  for (Pose2& T : T_graph_body) T = T_map_first * T;
  const FinalMap map = final_map(run, T_graph_body);
  EXPECT_EQ(map.counters.map_source, MapSource::kDeadReckoning);
  EXPECT_FALSE(map.counters.refined);
  for (std::size_t i = 0; i < map.T_map_body.size(); ++i)
    ASSERT_TRUE(poses_near(map.T_map_body[i], T_map_first * odometry(vehicle)[i], 1e-9, 1e-9)) << i;
}

TEST(RunRefinement, TheReportedOdometryIsCalibrated) {
  const TextRoom room = straight_corridor();
  TestVehicleModel short_metre;
  short_metre.odometry_scale = 0.8;
  TestVehicle vehicle(room, Pose2(room.place('a').x_m, room.place('a').y_m, 0.0), short_metre, 71);
  vehicle.fly_to(room, room.place('b'));
  const std::vector<Pose2> T_wound_up = bent(vehicle, 0.02);
  SensorModel sensor = SensorModel::crazyflie();
  sensor.odometry_calibration.forward_scale = 1.0 / short_metre.odometry_scale;
  const FinalMap map = final_map(StoredRun(vehicle.samples(), T_wound_up), T_wound_up, {}, {}, sensor);
  EXPECT_EQ(map.counters.map_source, MapSource::kDeadReckoning);
  EXPECT_TRUE(poses_near(map.T_map_body.back(), true_poses(vehicle).back(), 1e-9, 1e-9));
}

TEST(RunRefinement, AFalseClosureDoesNotBendTheMap) {
  // It puts the far end of the corridor where the run began, and the graph has followed.
  const TestVehicle vehicle = along_the_corridor();
  const StoredRun run(vehicle.samples());
  const std::vector<Pose2> T_round = bent(vehicle, 2.0 * kPi / 26.0);
  RelativePoseFactor<KeyframeId> closure{KeyframeId{0}, run.newest(), T_round.back()};
  closure.information = Eigen::Vector3d(400.0, 400.0, 1000.0).asDiagonal();
  closure.is_closure = true;
  const FinalMap map = final_map(run, T_round, std::vector{closure});
  EXPECT_NE(map.counters.map_source, MapSource::kPoseGraph);
  EXPECT_LT(aligned_rms_error_m(map.T_map_body, odometry(vehicle)), 0.1);
}

/// The odometry stands still from one sample to the other, as that of a flow sensor over a shiny floor does.
std::vector<RangeSample> slipped(std::vector<RangeSample> samples, std::size_t from, std::size_t to) {
  const Pose2 T_odom_stands = samples[from].T_odom_body;
  const Pose2 T_stands_moved = T_odom_stands * samples[to].T_odom_body.inverse();
  for (std::size_t i = from; i < samples.size(); ++i)
    samples[i].T_odom_body = i < to ? T_odom_stands : T_stands_moved * samples[i].T_odom_body;
  return samples;
}

/// Two laps whose odometry stands still over 2 m, which the graph doubts.
struct SlippedRun {
  SlippedRun() : vehicle(vehicle_at_start({}, 72)) {
    fly_along(vehicle, loop_corridor(), "bcdabcda");
    const std::size_t from = vehicle.samples().size() / 3;
    std::size_t to = from;
    while (distance_m(vehicle.samples()[to].T_odom_body.position(),
                      vehicle.samples()[from].T_odom_body.position()) < 2.0)
      ++to;
    run.emplace(slipped(vehicle.samples(), from, to));
    const KeyframeId before = run->scans().all().values()[from].keyframe;
    motion = {before, before + 1,
              between(run->T_local_keyframe()[before], run->T_local_keyframe()[before + 1])};
    motion.information = Eigen::Vector3d(1600.0, 1600.0, 1e4).asDiagonal();
    motion.is_closure = true;
    motion.dcs_scale = 1e-3;
    EXPECT_LT(to, index_of(run->chain().scan_of(before + 1)) + 1);
  }
  TestVehicle vehicle;
  std::optional<StoredRun> run;
  RelativePoseFactor<KeyframeId> motion;
};

TEST(RunRefinement, AMotionInDoubtIsAsLongAsTheGraphHasIt) {
  const SlippedRun slip;
  const std::vector<Pose2> truth = true_poses(slip.vehicle);
  const FinalMap map =
      final_map(*slip.run, truth, {}, {}, SensorModel::crazyflie(), {}, std::vector{slip.motion});
  ASSERT_EQ(map.counters.map_source, MapSource::kPoseGraph);
  EXPECT_LT(aligned_rms_error_m(map.T_map_body, truth), 0.06);
}

TEST(RunRefinement, AMotionInDoubtIsNoneForARunMappedAgainEither) {
  const SlippedRun slip;
  const std::vector<Pose2> truth = true_poses(slip.vehicle);
  BackendConfig config;
  config.tuning.refinement.correction_odds = 1e9;  // dead reckoning is not the map
  const auto again = [&](std::span<const double> step_scale) {
    if (!step_scale.empty()) return std::vector<OtherPath>{};
    return std::vector{OtherPath{MapSource::kBackwards, 1.0, truth}};
  };
  const FinalMap map = final_map(*slip.run, bent(slip.vehicle, 0.01), {}, config, SensorModel::crazyflie(),
                                 again, std::vector{slip.motion});
  ASSERT_EQ(map.counters.map_source, MapSource::kBackwards);
  EXPECT_LT(aligned_rms_error_m(map.T_map_body, truth), 0.06);
}

TEST(RunRefinement, WhereTheOdometryRestartedNothingHasMoved) {
  const TextRoom room = straight_corridor();
  TestVehicle vehicle = along_the_corridor();
  const std::size_t second = vehicle.samples().size();
  vehicle.carry_to(room, Pose2(room.place('a').x_m, room.place('a').y_m, 0.0));
  vehicle.fly_to(room, room.place('b'));
  const StoredRun run(vehicle.samples(), bent(vehicle, 0.02));
  BackendConfig config;
  config.tuning.refinement.refined_gain_sigmas = std::numeric_limits<double>::infinity();  // as reported
  const FinalMap map = final_map(run, bent(vehicle, 0.02), {}, config);
  ASSERT_EQ(map.counters.map_source, MapSource::kDeadReckoning);
  EXPECT_TRUE(poses_near(map.T_map_body[second], map.T_map_body[second - 1], 1e-9, 1e-9));
  for (std::size_t i = 1; i < map.T_map_body.size(); ++i) {
    if (i == second) continue;
    ASSERT_TRUE(poses_near(between(map.T_map_body[i - 1], map.T_map_body[i]),
                           between(vehicle.samples()[i - 1].T_odom_body, vehicle.samples()[i].T_odom_body),
                           1e-9, 1e-9))
        << i;
  }
}

TEST(RunRefinement, ARestartThatLoopsHaveBridgedIsNoDrift) {
  TestVehicle vehicle = vehicle_at_start({}, 73);
  fly_along(vehicle, loop_corridor(), "bcda");
  const Point2 c = loop_corridor().place('c');
  vehicle.carry_to(loop_corridor(), Pose2(c.x_m, c.y_m, kPi));
  fly_along(vehicle, loop_corridor(), "da");
  const StoredRun run(vehicle.samples(), bent(vehicle, 0.0));
  const std::vector<Pose2> truth = true_poses(vehicle);
  const FinalMap map = final_map(run, in_small_waves(truth));
  EXPECT_EQ(map.counters.map_source, MapSource::kPoseGraph);
  EXPECT_LT(aligned_rms_error_m(map.T_map_body, truth), 0.1);
}

/// One path, with the graph's, and what the map is then.
FinalMap final_map_beside(const OtherPath& other, const std::vector<Pose2>& T_graph_body) {
  const StoredRun run(two_laps().samples());
  return final_map(run, T_graph_body, {}, {}, SensorModel::crazyflie(),
                   [&](std::span<const double>) { return std::vector{other}; });
}

TEST(RunRefinement, AnotherPathThatExplainsTheRangesBetterIsTheMapAsItIs) {
  const std::vector<Pose2> truth = true_poses(two_laps());
  const FinalMap map = final_map_beside({MapSource::kOtherYawNoise, 0.5, truth}, bent(two_laps(), -0.015));
  EXPECT_EQ(map.counters.map_source, MapSource::kOtherYawNoise);
  EXPECT_EQ(map.counters.yaw_noise_factor, 0.5);
  EXPECT_TRUE(poses_near(between(map.T_map_body.front(), map.T_map_body.back()),
                         between(truth.front(), truth.back()), 1e-9, 1e-9));
}

TEST(RunRefinement, AnotherPathThatExplainsTheRangesNoBetterIsLeftOut) {
  const std::vector<Pose2> waves = in_small_waves(true_poses(two_laps()));
  const FinalMap alone = final_map(StoredRun(two_laps().samples()), waves);
  const FinalMap beside = final_map_beside({MapSource::kOtherYawNoise, 2.0, waves}, waves);
  EXPECT_EQ(beside.counters.map_source, MapSource::kPoseGraph);
  EXPECT_EQ(beside.counters.yaw_noise_factor, 1.0);
  EXPECT_TRUE(same_bits(beside.T_map_body, alone.T_map_body));
}

/// Few returns are held out, so that their misfit has little to say.
TEST(RunRefinement, AnotherPathThatDrawsTheBuildingOnceIsTheMapThoughItsOdometryErrsMore) {
  const TestVehicle vehicle = two_laps_that_drift(0.009);
  const std::vector<Pose2> truth = true_poses(vehicle);
  const std::vector<Pose2> twice = bent(vehicle, -0.001);  // the second lap beside the first
  const StoredRun run(vehicle.samples(), twice);
  SensorModel sensor = SensorModel::crazyflie();
  sensor.odometry.yaw_rad = sensor.odometry.yaw_rad.scaled(0.25);
  BackendConfig config;
  config.tuning.refinement.hold_out_every = 1009;
  config.tuning.refinement.correction_odds = 1e9;  // dead reckoning is not the map
  const BatchRefinement batch{.scans = run.scans(), .sensor = sensor, .config = config};
  const auto misfit = [&](const std::vector<Pose2>& path) {
    const std::vector<double> of_traversals = judge_as_it_is(batch, path).misfit;
    return std::accumulate(of_traversals.begin(), of_traversals.end(), 0.0);
  };
  ASSERT_LT(misfit(twice), misfit(truth));
  ASSERT_EQ(final_map(run, twice, {}, config, sensor).counters.map_source, MapSource::kPoseGraph);
  const FinalMap map = final_map(run, twice, {}, config, sensor, [&](std::span<const double>) {
    return std::vector{OtherPath{MapSource::kBackwards, 1.0, truth}};
  });
  EXPECT_EQ(map.counters.map_source, MapSource::kBackwards);
  EXPECT_LT(aligned_rms_error_m(map.T_map_body, truth), 0.1);
}

TEST(RunRefinement, WhereDeadReckoningIsTheMapTheRunIsNotMappedAgain) {
  const TestVehicle vehicle = along_the_corridor();
  bool was_asked = false;
  const FinalMap map =
      final_map(StoredRun(vehicle.samples()), bent(vehicle, 0.02), {}, {}, SensorModel::crazyflie(),
                [&](std::span<const double>) {
                  was_asked = true;
                  return std::vector{OtherPath{MapSource::kOtherYawNoise, 1.4, true_poses(vehicle)}};
                });
  EXPECT_FALSE(was_asked);
  EXPECT_EQ(map.counters.map_source, MapSource::kDeadReckoning);
}

/// Twice round the block. The flow sensor sees 70 % of the motion along the corridor in the east.
struct UnevenFlight {
  std::vector<RangeSample> samples = two_laps().samples();
  std::vector<Pose2> truth = true_poses(two_laps());

  UnevenFlight() {
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const Pose2 step = between(truth[i - 1], truth[i]);
      samples[i].T_odom_body = samples[i - 1].T_odom_body * stretched(step, is_plain(i) ? 0.7 : 1.0);
    }
  }
  [[nodiscard]] bool is_plain(std::size_t i) const {
    return truth[i].x_m() > loop_corridor().place('c').x_m - loop_corridor().place('a').x_m - 1.0;
  }
};

TEST(RunRefinement, FloorsThatTheOdometryMissesAreFoundAndTheRunIsMappedAgainWithThem) {
  const UnevenFlight flight;
  std::vector<std::vector<double>> asked;
  const MapAgain map_again = [&](std::span<const double> step_scale) {
    asked.emplace_back(step_scale.begin(), step_scale.end());
    return asked.size() == 1 ? std::vector<OtherPath>()
                             : std::vector{OtherPath{MapSource::kFloorKnown, 1.0, flight.truth}};
  };
  const FinalMap map = final_map(StoredRun(flight.samples), in_small_waves(flight.truth), {}, {},
                                 SensorModel::crazyflie(), map_again);
  EXPECT_GT(map.counters.floor_cost, FloorFieldTuning().min_cost);
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_TRUE(asked.front().empty());
  ASSERT_EQ(asked.back().size(), flight.samples.size());
  EXPECT_GT(*std::max_element(asked.back().begin(), asked.back().end()), 1.25);
  BackendConfig even;
  even.floor_varies = false;
  const FinalMap without = final_map(StoredRun(flight.samples), in_small_waves(flight.truth), {}, even);
  EXPECT_LT(aligned_rms_error_m(map.T_map_body, flight.truth),
            0.8 * aligned_rms_error_m(without.T_map_body, flight.truth));
}

TEST(RunRefinement, FloorsAreEvenUnlessAFlowSensorSawThem) {
  const UnevenFlight flight;
  BackendConfig even;
  even.floor_varies = false;
  const std::vector<Pose2> start = in_small_waves(flight.truth);
  EXPECT_EQ(final_map(StoredRun(flight.samples), start, {}, even).counters.floor_cost, 0.0);
  EXPECT_EQ(
      final_map(StoredRun(flight.samples), start, {}, {}, SensorModel::carmen_laser()).counters.floor_cost,
      0.0);
  EXPECT_EQ(final_map(StoredRun(two_laps().samples()), start).counters.floor_cost, 0.0);
}

/// A flight along the corridor whose graph is right but for small waves, and whose dead reckoning is 2 %
/// short, which no wall contradicts. One closure leads from the first keyframe to the newest.
class NewestStretch : public testing::Test {
 protected:
  NewestStretch() {
    for (const auto& [keyframe, scan] : run_.chain().all())
      graph_.T_map_keyframe.push_back(T_graph_body_[index_of(scan)]);
    RelativePoseFactor<KeyframeId> closure{KeyframeId{0}, run_.newest(),
                                           between(T_odom_body_.front(), T_odom_body_[index_of(newest_)])};
    closure.information = Eigen::Vector3d(2500.0, 2500.0, 1e4).asDiagonal();
    closure.is_closure = true;
    graph_.factors.push_back(closure);
    for (std::size_t i = 0; i < run_.scans().size(); ++i) refinement_.add_scan();
  }
  static std::vector<Pose2> shortened(std::vector<Pose2> path) {
    for (Pose2& T : path) T = Pose2(0.98 * T.x_m(), 0.98 * T.y_m(), T.yaw_rad());
    return path;
  }
  bool solve() {
    for (int slice = 0; slice < 20; ++slice) refinement_.continue_stretch();
    return refinement_.refine_stretch(graph_, false);
  }
  /// Of the newest scan, along the corridor.
  [[nodiscard]] double off_m() const {
    return between(T_odom_body_[index_of(newest_)], refinement_.T_map_body(newest_, graph_.T_map_keyframe))
        .x_m();
  }

  TestVehicle vehicle_ = along_the_corridor();
  std::vector<Pose2> T_odom_body_ = odometry(vehicle_);
  std::vector<Pose2> T_graph_body_ = in_small_waves(T_odom_body_);
  StoredRun run_{vehicle_.samples(), shortened(T_odom_body_)};
  ScanId newest_ = run_.chain().scan_of(run_.newest());
  PoseGraph graph_;
  BackendConfig config_;
  RunRefinement refinement_{config_, SensorModel::crazyflie(), run_.scans(), run_.chain()};
};

TEST_F(NewestStretch, IsHeldByAClosureWithinIt) {
  refinement_.refine_stretch(graph_, true);
  ASSERT_TRUE(solve());
  EXPECT_LT(std::abs(off_m()), 0.08);
}

TEST_F(NewestStretch, IsHeldByAClosureWithGroundBeforeIt) {
  config_.tuning.online.max_stretch_scans = run_.scans().size() / 2;
  refinement_.refine_stretch(graph_, true);
  ASSERT_TRUE(solve());
  EXPECT_LT(std::abs(off_m()), 0.08);
}

TEST_F(NewestStretch, WithoutAClosureItGoesBackToDeadReckoning) {
  graph_.factors.values().front().information.setZero();
  refinement_.refine_stretch(graph_, true);
  ASSERT_TRUE(solve());
  EXPECT_LT(off_m(), -0.2);
}

TEST_F(NewestStretch, OneInTheMiddleOfTheRunStaysWhereTheGraphHasIt) {
  graph_.factors.values().front().information.setZero();
  config_.tuning.online.max_stretch_scans = run_.scans().size() - 50;
  refinement_.refine_stretch(graph_, true);
  ASSERT_TRUE(solve());
  EXPECT_LT(std::abs(off_m()), 0.1);
}

TEST_F(NewestStretch, OneThatPruningInterruptsIsBegunAgain) {
  refinement_.refine_stretch(graph_, true);
  refinement_.erase({}, {});
  EXPECT_FALSE(refinement_.refine_stretch(graph_, false));
  EXPECT_TRUE(solve());
}

TEST(RunRefinement, TwoRunsGiveTheSameBytes) {
  const std::vector<Pose2> T_graph_body = in_small_waves(true_poses(two_laps()));
  const FinalMap one = final_map(StoredRun(two_laps().samples()), T_graph_body);
  const FinalMap other = final_map(StoredRun(two_laps().samples()), T_graph_body);
  EXPECT_TRUE(one.counters.refined);
  EXPECT_EQ(one.counters.map_source, other.counters.map_source);
  EXPECT_EQ(one.counters.held_out_after_m, other.counters.held_out_after_m);
  EXPECT_TRUE(same_bits(one.T_map_body, other.T_map_body));
}

TEST(RunRefinement, WithoutLoopClosingThePosesOfTheGraphStay) {
  const TestVehicle vehicle = along_the_corridor();
  const StoredRun run(vehicle.samples(), bent(vehicle, 0.02));
  BackendConfig config;
  config.close_loops = false;
  const FinalMap map = final_map(run, bent(vehicle, 0.02), {}, config);
  EXPECT_EQ(map.counters.map_source, MapSource::kPoseGraph);
  const auto newest = index_of(run.chain().scan_of(run.newest()));
  EXPECT_TRUE(poses_near(map.T_map_body[newest], bent(vehicle, 0.02)[newest], 1e-9, 1e-9));
}

TEST(MapSource, EachHasAName) {
  EXPECT_EQ(name_of(MapSource::kDeadReckoning), "dead reckoning");
  EXPECT_EQ(name_of(MapSource::kFrontend), "frontend");
  EXPECT_EQ(name_of(MapSource::kPoseGraph), "pose graph");
  EXPECT_EQ(name_of(MapSource::kOtherYawNoise), "other yaw noise");
  EXPECT_EQ(name_of(MapSource::kBackwards), "backwards");
  EXPECT_EQ(name_of(MapSource::kFloorKnown), "floor known");
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gtest/gtest.h>

#include <bit>
#include <memory>
#include <span>
#include <vector>

#include "core/backend/backend.hpp"
#include "tests/support/closure_error.hpp"
#include "tests/support/dead_reckoning_frontend.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/trajectory_error.hpp"

namespace swiftlet {
namespace {

constexpr int kMaxScans = 3000;         // more than what stays at least: about six laps
constexpr int kLaps = 12;               // of about 480 samples
constexpr double kChiSquare99 = 11.34;  // of three degrees of freedom

const TestVehicle& patrol() {
  static const TestVehicle kVehicle = [] {
    TestVehicleModel model;
    model.step_m = 0.1;
    model.drift_rad_per_m = 0.004;
    model.odometry_sigma_m = 0.003;
    TestVehicle vehicle = vehicle_at_start(model, 3);
    for (int lap = 0; lap < kLaps; ++lap) fly_along(vehicle, loop_corridor(), "bcda");
    return vehicle;
  }();
  return kVehicle;
}

BackendConfig holding(int scans) {
  BackendConfig config;
  config.max_scans = scans;
  return config;
}

/// A patrol through a backend that forgets, and where each scan that it still has was in truth.
struct Patrol {
  explicit Patrol(const BackendConfig& config) {
    backend = std::make_unique<Backend>(config, SensorModel::crazyflie(), BeamLayout::multiranger());
    DeadReckoningFrontend frontend;
    for (const RangeSample& sample : patrol().samples()) {
      backend->add(frontend.process(sample));
      const Pruning pruning = backend->next_pruning();
      pruned += pruning.scan_count;
      backend->prune(pruning);
      max_scans = std::max(max_scans, backend->scans().size());
    }
  }
  [[nodiscard]] double error_m() const {
    std::vector<Pose2> estimate;
    std::vector<Pose2> truth;
    for (const auto& [id, scan] : backend->scans().all()) {
      estimate.push_back(backend->T_map_body(id));
      truth.push_back(patrol().T_world_body()[index_of(id)]);
    }
    return aligned_rms_error_m(estimate, truth);
  }
  std::unique_ptr<Backend> backend;
  std::size_t pruned = 0;
  std::size_t max_scans = 0;
};

const Patrol& finished_patrol() {
  static const Patrol kPatrol = [] {
    Patrol run(holding(kMaxScans));
    run.backend->finish();
    return run;
  }();
  return kPatrol;
}

TEST(BackendPruning, HoldsNoMoreScansThanItIsAllowedInKnownSpace) {
  ASSERT_GT(2 * patrol().samples().size(), 3U * kMaxScans);
  EXPECT_LE(finished_patrol().max_scans, kMaxScans + kMaxScans / 10);
  EXPECT_EQ(finished_patrol().pruned + finished_patrol().backend->scans().size(), patrol().samples().size());
  EXPECT_EQ(finished_patrol().backend->counters().scans, patrol().samples().size());
  EXPECT_FALSE(finished_patrol().backend->can_be_mapped_again());
  EXPECT_EQ(finished_patrol().backend->counters().scans_pruned, finished_patrol().pruned);
}

/// After how many samples pruning is due for the first time; 0: never.
std::size_t first_pruning(std::span<const RangeSample> samples) {
  Backend backend(holding(kMaxScans), SensorModel::crazyflie(), BeamLayout::multiranger());
  DeadReckoningFrontend frontend;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    backend.add(frontend.process(samples[i]));
    if (!backend.next_pruning().empty()) return i + 1;
  }
  return 0;
}

TEST(BackendPruning, WaitsWhileTravelHasNoPlace) {
  std::vector<RangeSample> samples = patrol().samples();
  const std::size_t usual = first_pruning(samples);
  ASSERT_GT(usual, 100U);
  samples[usual - 20].starts_segment = true;  // a restart: some metres tell where
  samples.resize(usual + kMaxScans / 5);
  const std::size_t later = first_pruning(samples);
  EXPECT_GT(later, usual);
  EXPECT_LE(later, usual + kMaxScans / 10);
}

TEST(BackendPruning, KeepsTheMapAsGoodAsWithoutForgetting) {
  Patrol all(holding(1'000'000));
  all.backend->finish();
  EXPECT_EQ(all.pruned, 0U);
  EXPECT_LT(finished_patrol().error_m(), all.error_m() + 0.03);
  EXPECT_EQ(finished_patrol().backend->counters().solver_failures, 0U);
}

TEST(BackendPruning, IsTheSameFromRunToRun) {
  Patrol again(holding(kMaxScans));
  again.backend->finish();
  ASSERT_EQ(again.backend->scans().size(), finished_patrol().backend->scans().size());
  for (const auto& [id, scan] : again.backend->scans().all()) {
    ASSERT_TRUE(finished_patrol().backend->scans().all().contains(id));
    ASSERT_EQ(std::bit_cast<std::uint64_t>(again.backend->T_map_body(id).x_m()),
              std::bit_cast<std::uint64_t>(finished_patrol().backend->T_map_body(id).x_m()));
  }
}

TEST(BackendPruning, EverythingThatStaysKeepsItsId) {
  const Backend& backend = *finished_patrol().backend;
  EXPECT_EQ(index_of(backend.keyframes().all().end_id()), backend.counters().keyframes);
  EXPECT_EQ(index_of(backend.scans().all().end_id()), backend.counters().scans);
  std::uint32_t expected = 0;
  for (const auto& [id, scan] : backend.scans().all()) {
    EXPECT_EQ(scan.stamp, patrol().samples()[index_of(id)].stamp);
    EXPECT_TRUE(index_of(id) == expected || scan.starts_segment) << "after a hole begins a segment";
    expected = index_of(id) + 1;
    ASSERT_TRUE(backend.keyframes().all().contains(scan.keyframe));
  }
  for (const auto& [id, closure] : backend.closures()) {
    EXPECT_EQ(closure.id, id);
    EXPECT_TRUE(backend.keyframes().all().contains(closure.from));
    EXPECT_TRUE(backend.keyframes().all().contains(closure.to));
  }
  EXPECT_EQ(index_of(backend.closures().end_id()), backend.counters().closures_accepted);
}

TEST(BackendPruning, NeedsNoRefinement) {
  BackendConfig config = holding(kMaxScans);
  config.refine = false;
  const Patrol run(config);
  EXPECT_GT(run.pruned, 0U);
  EXPECT_LE(run.max_scans, kMaxScans + kMaxScans / 10);
}

TEST(BackendPruning, ClosuresThatStayAreStillTrue) {
  const Backend& backend = *finished_patrol().backend;
  const auto truth_at = [&](KeyframeId keyframe) {
    return patrol().T_world_body()[index_of(backend.keyframes().scan_of(keyframe))];
  };
  ASSERT_GT(backend.closures().size(), 20U);
  std::size_t within = 0;
  for (const LoopClosure& closure : backend.closures().values()) {
    const Pose2 T_truth = between(truth_at(closure.from), truth_at(closure.to));
    within += chi_square_against(closure, T_truth) < kChiSquare99 ? 1U : 0U;
  }
  EXPECT_GE(static_cast<double>(within), 0.95 * static_cast<double>(backend.closures().size()));
}

TEST(BackendPruningDeathTest, WhatWasPrunedCannotBeAskedFor) {
  const Backend& backend = *finished_patrol().backend;
  std::uint32_t gone = 0;
  while (backend.keyframes().all().contains(make_id<KeyframeId>(gone))) ++gone;
  ASSERT_LT(gone, index_of(backend.keyframes().all().end_id()));
  EXPECT_DEATH((void)backend.T_map_keyframe(make_id<KeyframeId>(gone)), "broken promise.*not erased");
}

}  // namespace
}  // namespace swiftlet

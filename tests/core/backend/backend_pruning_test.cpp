// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gtest/gtest.h>

#include <bit>
#include <memory>

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

/// A patrol through a backend that forgets, and where each scan that it still has was in truth.
struct Patrol {
  explicit Patrol(int max_scans_kept) {
    BackendConfig config;
    config.max_scans = max_scans_kept;
    backend = std::make_unique<Backend>(config, SensorModel::crazyflie(), BeamLayout::multiranger());
    DeadReckoningFrontend frontend;
    for (const RangeSample& sample : patrol().samples()) {
      backend->add(frontend.process(sample));
      const Pruning pruning = backend->next_pruning();
      pruned += pruning.scans.size();
      backend->prune(pruning);
      max_scans = std::max(max_scans, backend->scans().size());
    }
  }
  [[nodiscard]] double error_m() const {
    std::vector<Pose2> estimate;
    std::vector<Pose2> truth;
    for (ScanIndex i = 0; i < backend->scans().size(); ++i) {
      estimate.push_back(backend->T_map_body(i));
      truth.push_back(patrol().T_world_body()[backend->scans()[i].number]);
    }
    return aligned_rms_error_m(estimate, truth);
  }
  std::unique_ptr<Backend> backend;
  std::size_t pruned = 0;
  std::size_t max_scans = 0;
};

const Patrol& finished_patrol() {
  static const Patrol kPatrol = [] {
    Patrol run(kMaxScans);
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
  EXPECT_EQ(finished_patrol().backend->counters().scans_pruned, finished_patrol().pruned);
}

TEST(BackendPruning, KeepsTheMapAsGoodAsWithoutForgetting) {
  Patrol all(1'000'000);
  all.backend->finish();
  EXPECT_EQ(all.pruned, 0U);
  EXPECT_LT(finished_patrol().error_m(), all.error_m() + 0.03);
  EXPECT_EQ(finished_patrol().backend->counters().solver_failures, 0U);
}

TEST(BackendPruning, IsTheSameFromRunToRun) {
  Patrol again(kMaxScans);
  again.backend->finish();
  ASSERT_EQ(again.backend->scans().size(), finished_patrol().backend->scans().size());
  for (ScanIndex i = 0; i < again.backend->scans().size(); ++i) {
    ASSERT_EQ(again.backend->scans()[i].number, finished_patrol().backend->scans()[i].number);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(again.backend->T_map_body(i).x_m()),
              std::bit_cast<std::uint64_t>(finished_patrol().backend->T_map_body(i).x_m()));
  }
}

TEST(BackendPruning, NumbersEverythingAnew) {
  const Backend& backend = *finished_patrol().backend;
  const auto keyframes = static_cast<std::uint32_t>(backend.keyframe_count());
  for (std::uint32_t k = 0; k < keyframes; ++k) {
    const auto id = static_cast<KeyframeId>(k);
    EXPECT_EQ(backend.keyframe_of(backend.frontend_id(id)), id);
    EXPECT_TRUE(k == 0 || backend.frontend_id(static_cast<KeyframeId>(k - 1)) < backend.frontend_id(id));
  }
  std::uint32_t number = 0;
  for (ScanIndex i = 0; i < backend.scans().size(); ++i) {
    const StoredScan& scan = backend.scans()[i];
    EXPECT_TRUE(i == 0 || scan.number > number);
    if (i > 0 && scan.number != number + 1) {
      EXPECT_TRUE(scan.starts_segment) << "after a hole begins a segment";
    }
    number = scan.number;
    ASSERT_LT(index_of(scan.keyframe), keyframes);
  }
  for (const LoopClosure& closure : backend.closures()) {
    EXPECT_LT(index_of(closure.from), keyframes);
    EXPECT_LT(index_of(closure.to), keyframes);
    EXPECT_LT(closure.number, backend.counters().closures_accepted);
  }
}

TEST(BackendPruning, ClosuresThatStayAreStillTrue) {
  const Backend& backend = *finished_patrol().backend;
  const auto truth_at = [&](KeyframeId keyframe) {
    ScanIndex scan = 0;
    while (backend.scans()[scan].keyframe != keyframe) ++scan;
    return patrol().T_world_body()[backend.scans()[scan].number];
  };
  ASSERT_GT(backend.closures().size(), 20U);
  std::size_t within = 0;
  for (const LoopClosure& closure : backend.closures()) {
    const Pose2 T_truth = between(truth_at(closure.from), truth_at(closure.to));
    within += chi_square_against(closure, T_truth) < kChiSquare99 ? 1U : 0U;
  }
  EXPECT_GE(static_cast<double>(within), 0.95 * static_cast<double>(backend.closures().size()));
}

TEST(BackendPruningDeathTest, WhatWasPrunedCannotBeAskedFor) {
  const Backend& backend = *finished_patrol().backend;
  std::uint32_t gone = 0;
  for (std::uint32_t k = 1; k < backend.keyframe_count(); ++k) {
    const std::uint32_t before = index_of(backend.frontend_id(static_cast<KeyframeId>(k - 1)));
    if (index_of(backend.frontend_id(static_cast<KeyframeId>(k))) > before + 1) gone = before + 1;
  }
  ASSERT_GT(gone, 0U);
  EXPECT_DEATH((void)backend.keyframe_of(static_cast<KeyframeId>(gone)), "broken promise.*not pruned");
}

}  // namespace
}  // namespace swiftlet

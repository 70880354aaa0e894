// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/stretch_refinement.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry/rigid_alignment.hpp"
#include "tests/support/loop_corridor.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/stored_run.hpp"
#include "tests/support/trajectory_error.hpp"

namespace swiftlet {
namespace {

/// Four times along one side of the building. The dead reckoning does not err, hence is the truth.
TestVehicle to_and_fro() {
  TestVehicle vehicle = vehicle_at_start({}, 61);
  fly_along(vehicle, loop_corridor(), "baba");
  return vehicle;
}

struct Flown {
  TestVehicle vehicle = to_and_fro();
  StoredRun run{vehicle.samples()};
  SensorModel sensor = SensorModel::crazyflie();
  BackendConfig config;

  [[nodiscard]] BatchRefinement batch(const ScanRange& range = {}) const {
    return {.scans = run.scans(), .sensor = sensor, .config = config, .range = range};
  }
  [[nodiscard]] const Pose2& truth(ScanId scan) const {
    return vehicle.samples()[index_of(scan)].T_odom_body;
  }
  /// As a closure leaves it that is not exact: the second half lies 30 cm off.
  [[nodiscard]] std::vector<Pose2> torn(const ScanRange& range) const {
    std::vector<Pose2> T_map_graph;
    const ScanId middle = make_id<ScanId>(run.scans().size() / 2);
    for (ScanId i = range.first; i < range.end; ++i)
      T_map_graph.push_back(i < middle ? truth(i) : Pose2(0.1, 0.28, 0.01) * truth(i));
    return T_map_graph;
  }
  [[nodiscard]] ScanRange all() const { return {ScanId{}, run.scans().all().end_id()}; }
};

int slices_of(StretchRefinement& stretch) {
  int slices = 0;
  while (!stretch.is_solved()) {
    EXPECT_TRUE(stretch.step());
    ++slices;
  }
  return slices;
}

TEST(StretchRefinement, ThePartsOfALoopFindToEachOther) {
  const Flown flown;
  const std::vector<Pose2> torn = flown.torn(flown.all());
  StretchRefinement stretch;
  stretch.begin(flown.batch(), torn, Pose2());
  slices_of(stretch);
  const std::optional<StretchRefinement::Found> found = stretch.finish();
  ASSERT_TRUE(found);
  EXPECT_FALSE(stretch.is_busy());
  EXPECT_EQ(found->scans, flown.all());
  ASSERT_EQ(found->T_graph_refined.size(), torn.size());
  std::vector<Pose2> refined;
  std::vector<Pose2> truth;
  for (std::size_t i = 0; i < torn.size(); ++i) {
    refined.push_back(torn[i] * found->T_graph_refined[i]);
    truth.push_back(flown.truth(make_id<ScanId>(i)));
  }
  EXPECT_GT(aligned_rms_error_m(torn, truth), 0.1);
  EXPECT_LT(aligned_rms_error_m(refined, truth), 0.05);
}

TEST(StretchRefinement, ASliceIsARoundOrAStep) {
  const Flown flown;
  StretchRefinement stretch;
  stretch.begin(flown.batch(), flown.torn(flown.all()), Pose2());
  const BackendTuning& tuning = flown.config.tuning;
  EXPECT_EQ(slices_of(stretch), tuning.refinement.wide_iterations + 1 + tuning.joint.steps_per_association);
  EXPECT_TRUE(stretch.step()) << "and then nothing more is done";
  EXPECT_TRUE(stretch.is_solved());
}

std::vector<Point2> positions(const std::vector<Pose2>& poses) {
  std::vector<Point2> points;
  points.reserve(poses.size());
  for (const Pose2& T : poses) points.push_back(T.position());
  return points;
}

TEST(StretchRefinement, OneInTheMiddleOfARunLiesOnTheGraphAsAWhole) {
  const Flown flown;
  const ScanRange newest{make_id<ScanId>(flown.run.scans().size() / 8), flown.all().end};
  const std::vector<Pose2> torn = flown.torn(newest);
  StretchRefinement stretch;
  stretch.begin(flown.batch(newest), torn, Pose2(0.07, -0.04, 0.1));
  slices_of(stretch);
  const std::optional<StretchRefinement::Found> found = stretch.finish();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->scans, newest);
  std::vector<Pose2> refined;
  std::vector<Pose2> truth;
  for (std::size_t i = 0; i < torn.size(); ++i) {
    refined.push_back(torn[i] * found->T_graph_refined[i]);
    truth.push_back(flown.truth(newest.first + static_cast<std::uint32_t>(i)));
  }
  EXPECT_LT(aligned_rms_error_m(refined, truth), 0.05);
  EXPECT_TRUE(poses_near(rigid_alignment(positions(refined), positions(torn)), Pose2(), 1e-6, 1e-6));
}

TEST(StretchRefinement, IsRefusedWhereHeldOutReturnsDisagree) {
  // A closure that is far off and claims to be sure tears apart what fits.
  const Flown flown;
  std::vector<Pose2> T_map_graph;
  for (const RangeSample& sample : flown.vehicle.samples()) T_map_graph.push_back(sample.T_odom_body);
  const ScanId last = flown.run.scans().all().last_id();
  const std::vector<RelativePoseFactor<ScanId>> closures{
      {ScanId{}, last, between(T_map_graph.front(), Pose2(0.0, 1.0, 0.3) * T_map_graph.back()),
       1e9 * Eigen::Matrix3d::Identity(), true}};
  BatchRefinement batch = flown.batch();
  batch.closures = closures;
  StretchRefinement stretch;
  stretch.begin(batch, T_map_graph, Pose2());
  slices_of(stretch);
  EXPECT_FALSE(stretch.finish());
  EXPECT_FALSE(stretch.is_busy());
}

TEST(StretchRefinement, OfManyReturnsEveryNthCounts) {
  const Flown flown;
  BatchRefinement batch = flown.batch();
  const std::size_t hits = BatchProblem(batch).hits().size();
  batch.max_returns = flown.run.scans().return_count(flown.all()) / 3;
  const std::size_t thinned = BatchProblem(batch).hits().size();
  EXPECT_LE(thinned, batch.max_returns);
  EXPECT_GT(thinned, hits / 9);
}

}  // namespace
}  // namespace swiftlet

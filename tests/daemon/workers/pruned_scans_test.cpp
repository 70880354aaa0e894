// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/pruned_scans.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "tests/daemon/outputs/temporary_directory.hpp"
#include "tests/support/forgetful_run.hpp"

namespace swiftlet {
namespace {

std::vector<TrajectoryPoint> visited(const Backend& backend, const PrunedScans* pruned) {
  std::vector<TrajectoryPoint> points;
  const Status status =
      for_each_scan(backend, pruned, [&](const TrajectoryPoint& point) { points.push_back(point); });
  EXPECT_TRUE(status.ok());
  return points;
}

TEST(PrunedScans, EverySampleOfTheRunIsVisitedOnceInOrder) {
  const TemporaryDirectory directory;
  Result<PrunedScans> pruned = PrunedScans::open(directory.path());
  ASSERT_TRUE(pruned.ok());
  ForgetfulRun run;
  for (RangeSample& sample : run.samples) sample.storey = make_id<StoreyId>(1);
  run.fly([&](const Pruning& pruning) { pruned->take(run.backend, pruning); });
  run.backend.finish();
  ASSERT_GT(run.pruned_scans, 1000U);
  const std::vector<TrajectoryPoint> points = visited(run.backend, &*pruned);
  ASSERT_EQ(points.size(), run.samples.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(points[i].stamp, run.samples[i].stamp);
    ASSERT_EQ(points[i].storey, run.samples[i].storey);
    EXPECT_EQ(points[i].T_odom_body.x_m(), run.samples[i].T_odom_body.x_m());
    // The odometry of this flight is exact, and the map begins where it does.
    const Pose2 T_map_truth = between(run.samples[0].T_odom_body, run.samples[i].T_odom_body);
    const Pose2 off = between(points[i].T_map_body, T_map_truth);
    EXPECT_LT(std::hypot(off.x_m(), off.y_m()), 0.15) << i;
  }
}

TEST(PrunedScans, WithoutThemWhatTheBackendHasIsVisited) {
  ForgetfulRun run;
  run.fly([](const Pruning&) {});
  EXPECT_EQ(visited(run.backend, nullptr).size(), run.backend.scans().size());
}

TEST(PrunedScans, LeaveNoFileBehind) {
  const TemporaryDirectory directory;
  const Result<PrunedScans> pruned = PrunedScans::open(directory.path());
  ASSERT_TRUE(pruned.ok());
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

TEST(PrunedScans, ADirectoryThatIsNotThereIsSaid) {
  const Result<PrunedScans> pruned = PrunedScans::open("/nonexistent/directory");
  ASSERT_FALSE(pruned.ok());
  EXPECT_NE(pruned.error().message.find("/nonexistent/directory"), std::string::npos);
}

TEST(PrunedScans, AFullDiskIsSaidAtTheEnd) {
  // Nothing fits on this device.
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TemporaryDirectory directory;
  std::filesystem::create_symlink("/dev/full", directory.path() / ".pruned_scans");
  Result<PrunedScans> pruned = PrunedScans::open(directory.path());
  ASSERT_TRUE(pruned.ok());
  ForgetfulRun run;
  run.fly([&](const Pruning& pruning) { pruned->take(run.backend, pruning); });
  const Status status = for_each_scan(run.backend, &*pruned, [](const TrajectoryPoint&) {});
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::kOutOfSpace);
}

}  // namespace
}  // namespace swiftlet

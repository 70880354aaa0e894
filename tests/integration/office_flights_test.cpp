// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
//
// What the demo promises: the simulated office comes out right whatever the seed.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/evaluation/trajectory_error.hpp"
#include "tests/support/corrected_run.hpp"

namespace swiftlet {
namespace {

std::vector<Point2> positions(const std::vector<Pose2>& poses) {
  std::vector<Point2> points;
  for (const Pose2& pose : poses) points.push_back(pose.position());
  return points;
}

class OfficeFlights : public testing::TestWithParam<int> {};

TEST_P(OfficeFlights, AreCorrectedToAFifthOfTheOdometrysError) {
  const CorrectedRun run = corrected_run("sim://office?seed=" + std::to_string(GetParam()));
  ASSERT_GT(run.samples.size(), 4000U);
  ASSERT_EQ(run.truth.size(), run.samples.size());
  std::vector<Point2> truth_m;
  for (const StampedPose& at : run.truth) truth_m.push_back(at.pose.position());
  const double before_m = trajectory_error(positions(dead_reckoned(run)), truth_m).rmse_m;
  const double after_m = trajectory_error(positions(run.T_map_body), truth_m).rmse_m;
  EXPECT_LE(after_m, 0.2 * before_m) << before_m << " m before, " << after_m << " m after";
}

INSTANTIATE_TEST_SUITE_P(Seeds, OfficeFlights, testing::Range(1, 6));

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/run/mapping_run.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/core/calibration/room_flight.hpp"

namespace swiftlet {
namespace {

TEST(MappingRun, GivesEverySampleAPose) {
  const std::vector<RangeSample> samples = samples_of({});
  const Result<MappingRun> run = map_samples(samples, {.sensor = SensorModel::crazyflie()},
                                             BeamLayout::multiranger(), [](double) { return true; });
  ASSERT_TRUE(run);
  ASSERT_EQ(run->T_map_body.size(), samples.size());
  EXPECT_GT(run->counters.keyframes, 10U);
  const Pose2 truth = between(true_pose(0.0), true_pose(0.1 * static_cast<double>(samples.size() - 1)));
  const Pose2 found = between(run->T_map_body.front(), run->T_map_body.back());
  EXPECT_NEAR(found.x_m(), truth.x_m(), 0.15);
  EXPECT_NEAR(found.y_m(), truth.y_m(), 0.15);
}

TEST(MappingRun, StopsWhenToldTo) {
  const Result<MappingRun> stopped = map_samples(samples_of({}), {.sensor = SensorModel::crazyflie()},
                                                 BeamLayout::multiranger(), [](double) { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kTimeout);
}

}  // namespace
}  // namespace swiftlet

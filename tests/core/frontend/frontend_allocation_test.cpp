// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gtest/gtest.h>

#include "core/frontend/frontend.hpp"
#include "tests/core/frontend/room_drive.hpp"
#include "tests/support/allocation_counter.hpp"

namespace swiftlet {
namespace {

class FrontendAllocation : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::counts_allocations()) GTEST_SKIP() << "sanitizers bring a malloc of their own";
  }
};

TEST_F(FrontendAllocation, InterposingSeesWhatEigenAllocates) {
  const test::AllocationCounter counter;
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(50, 50);
  EXPECT_GT(counter.count(), 0U);
  EXPECT_EQ(matrix.rows(), 50);
}

TEST_F(FrontendAllocation, ProcessingAllocatesNothing) {
  FrontendConfig config;
  config.window_keyframes = 64;  // the largest system it can get
  config.association_keyframes = 64;
  const test::RoomDrive drive =
      test::drive_around(3, BeamLayout::multiranger(), SensorModel::crazyflie(), {1.0, 0.0}, 1);
  Frontend frontend(config, SensorModel::crazyflie(), BeamLayout::multiranger());
  {
    const test::AllocationCounter counter;
    for (const RangeSample& sample : drive.samples) frontend.process(sample);
    EXPECT_EQ(counter.count(), 0U);
  }
  EXPECT_GT(frontend.counters().poses_retired, 0U);
  EXPECT_GT(frontend.counters().observations_added, 100U);
}

}  // namespace
}  // namespace swiftlet

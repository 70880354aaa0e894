// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
// Breaks of motion in simulated flights: what was mapped before stays right, and the vehicle finds back.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/corrected_run.hpp"

namespace swiftlet {
namespace {

class MotionBreaksTest : public testing::TestWithParam<const char*> {};

TEST_P(MotionBreaksTest, LeavesTheMapRight) {
  const CorrectedRun run = corrected_run(std::string("sim://maze?seed=2&fault=") + GetParam());
  ASSERT_EQ(run.truth.size(), run.samples.size());
  EXPECT_LT(error_m(run), 0.15);
}

INSTANTIATE_TEST_SUITE_P(Kinds, MotionBreaksTest,
                         testing::Values("silence@150:60", "reset@150", "restart@150:60", "carried@150:60"));

}  // namespace
}  // namespace swiftlet

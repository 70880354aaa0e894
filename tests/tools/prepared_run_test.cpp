// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/prepared_run.hpp"

#include <gtest/gtest.h>

#include <string>

namespace swiftlet {
namespace {

Result<PreparedRun> prepared(const std::string& input, bool calibrate = true) {
  MapCommand command;
  command.input = input;
  command.calibrate = calibrate;
  return prepare_run(command);
}

// The flight reports 0.9 m in reverse as forward: one clear stretch.
constexpr const char* kLosesSigns = "sim://building?seed=378";

TEST(PreparedRun, MendsSignsWhereThatMapExplainsTheRangesBetter) {
  const Result<PreparedRun> run = prepared(kLosesSigns);
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->signs, LostSigns::kMendedIfLikely);
  EXPECT_TRUE(run->notes.empty());
}

TEST(PreparedRun, LeavesSignsAsReportedWhereThatMapExplainsTheRangesNoBetter) {
  const Result<PreparedRun> run = prepared("sim://building?seed=180");  // a clear stretch, but the wrong one
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->signs, LostSigns::kAsReported);
  ASSERT_EQ(run->notes.size(), 1U);
  EXPECT_NE(run->notes.front().find("taken as reported"), std::string::npos);
}

TEST(PreparedRun, WithoutAMapBeforehandSignsAreMendedOnlyWhereTheyAreSure) {
  const Result<PreparedRun> run = prepared(kLosesSigns, false);
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->signs, LostSigns::kMendedIfSure);
}

TEST(PreparedRun, DeadReckoningAloneStaysAsReported) {
  MapCommand command;
  command.input = kLosesSigns;
  command.odometry_only = true;
  const Result<PreparedRun> run = prepare_run(command);
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->signs, LostSigns::kAsReported);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/latency/latency_table.hpp"

#include <gmock/gmock.h>

#include "tests/tools/latency/timing_reports.hpp"

namespace swiftlet {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

TEST(LatencyTable, HasALineAStageAndALineAQueue) {
  const std::string table = latency_table(late_once());
  EXPECT_THAT(table, ContainsRegex("frame_to_pose +1000 +0.1050 +0.1000 +0.1000 +0.1000 +5.0000\n"));
  EXPECT_THAT(table, ContainsRegex("poses +256 +3 +0\n"));
}

TEST(LatencyTable, SaysHowThePosesMetTheirDeadline) {
  TimingReport report = late_once();
  EXPECT_THAT(latency_table(report), HasSubstr("1 of 1000 poses missed the deadline of 2 ms\n"));
  report.pose_deadline_ms.reset();  // as from a status
  EXPECT_THAT(latency_table(report), HasSubstr("1 of 1000 poses missed their deadline\n"));
  EXPECT_THAT(latency_table(TimingReport{}), HasSubstr("no pose was published\n"));
}

}  // namespace
}  // namespace swiftlet

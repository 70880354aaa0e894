// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/latency/timing_report.hpp"

#include <gmock/gmock.h>

#include "daemon/outputs/run_report.hpp"
#include "tests/daemon/outputs/finished_run.hpp"
#include "tests/daemon/outputs/temporary_directory.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;

class TimingReportTest : public testing::Test {
 protected:
  [[nodiscard]] Result<TimingReport> read(const std::string& text) const {
    std::ofstream(directory_.path() / "report.json") << text;
    return read_timing_report(directory_.path() / "report.json");
  }
  TemporaryDirectory directory_;
};

TEST_F(TimingReportTest, ReadsWhatTheDaemonWrote) {
  FinishedRun run;
  run.timing.queues = {{.name = "poses", .capacity = 256, .high_water = 3, .refused = 1}};
  run.timing.missed_deadlines = 5;
  const Result<TimingReport> report = read(run_report_json(run.view(false)));
  ASSERT_TRUE(report.ok()) << report.error().message;
  ASSERT_EQ(report->stages.size(), 1U);
  EXPECT_EQ(report->stages[0].name, "frontend");
  EXPECT_EQ(report->stages[0].count, 81U);
  EXPECT_EQ(report->stages[0].p999_ms, 0.45);
  ASSERT_EQ(report->buckets.size(), 1U);
  ASSERT_EQ(report->buckets[0].buckets.size(), 2U);
  EXPECT_EQ(report->buckets[0].buckets[1].upper_ns, 507'903U);
  EXPECT_EQ(report->buckets[0].buckets[1].count, 1U);
  ASSERT_EQ(report->queues.size(), 1U);
  EXPECT_EQ(report->queues[0].name, "poses");
  EXPECT_EQ(report->queues[0].high_water, 3U);
  EXPECT_EQ(report->pose_deadline_ms, 2.0);
  EXPECT_EQ(report->missed_deadlines, 5U);
}

TEST_F(TimingReportTest, LeavesOutStagesThatNeverRanAndQueuesThatNobodyUsed) {
  FinishedRun run;
  run.timing.stages.push_back({.name = "frame_to_pose"});
  run.timing.buckets.push_back({.name = "frame_to_pose", .buckets = {}});
  const Result<TimingReport> report = read(run_report_json(run.view(false)));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->stages.size(), 1U);
  EXPECT_TRUE(report->queues.empty());
  EXPECT_FALSE(report->pose_deadline_ms.has_value());
}

TEST_F(TimingReportTest, RefusesWhatIsNoSuchReport) {
  for (const char* text : {"no json", "[]", "{}", R"({"stage_times": {"map": {"count": 1}}})",
                           R"({"stage_times": 3, "histograms_ns": {}})"}) {
    const Result<TimingReport> report = read(text);
    ASSERT_FALSE(report.ok()) << text;
    EXPECT_EQ(report.error().code, ErrorCode::kInvalidInput);
    EXPECT_THAT(report.error().message, HasSubstr("report.json: not a report.json with the times of a run"));
  }
  EXPECT_THAT(read("").error().message, HasSubstr("report.json: is empty"));
  EXPECT_EQ(read_timing_report("/nowhere/report.json").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace swiftlet

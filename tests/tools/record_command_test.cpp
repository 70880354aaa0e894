// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/record_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "firmware_link/input/open_sample_source.hpp"
#include "tests/daemon/outputs/temporary_directory.hpp"

namespace swiftlet {
namespace {

TEST(RecordingSummary, HasEverythingThatOneWantsToSeeWhileFlying) {
  EXPECT_EQ(recording_summary(4521, 9.96, 45, 296'048), "4521 samples, 10.0 Hz, 45 gaps, 296 kB");
}

TEST(RunRecordCommand, RefusesAFileWithoutAName) {
  const Status recorded = run_record_command({.input = "sim://patrol", .file = "", .seconds = 1.0});
  ASSERT_FALSE(recorded.ok());
  EXPECT_EQ(recorded.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(recorded.error().message, testing::StartsWith("-o names no file"));
}

TEST(RunRecordCommand, EndsWhenItsTimeIsUpByTheLinksOwnClock) {
  const TemporaryDirectory directory;
  const auto seconds_recorded = [&directory](double wanted) {
    const std::string file = directory.path() / (std::to_string(wanted) + ".pcap");
    EXPECT_TRUE(run_record_command({.input = "sim://office?seed=7", .file = file, .seconds = wanted}).ok());
    const Result<std::unique_ptr<SampleSource>> source = open_sample_source(file, {});
    EXPECT_TRUE(source.ok());
    const HostTime first = (*source)->next()->sample.stamp;
    HostTime last = first;
    for (Result<ReceivedSample> received = (*source)->next(); received; received = (*source)->next())
      last = received->sample.stamp;
    return to_seconds(last - first);
  };
  EXPECT_NEAR(seconds_recorded(30.0), 30.0, 0.5);
  EXPECT_NEAR(seconds_recorded(60.0), 60.0, 0.5);
}

}  // namespace
}  // namespace swiftlet

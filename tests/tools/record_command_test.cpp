// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/record_command.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/daemon/outputs/temporary_directory.hpp"

namespace swiftlet {
namespace {

TEST(RecordingSummary, HasEverythingThatOneWantsToSeeWhileFlying) {
  EXPECT_EQ(recording_summary(4521, 9.96, 45, 296'048), "4521 samples, 10.0 Hz, 45 gaps, 296 kB");
}

TEST(RunRecordCommand, EndsWhenItsTimeIsUpByTheLinksOwnClock) {
  const TemporaryDirectory directory;
  const std::filesystem::path half = directory.path() / "half.pcap";
  const std::filesystem::path whole = directory.path() / "whole.pcap";
  ASSERT_TRUE(run_record_command({.input = "sim://office?seed=7", .file = half, .seconds = 30.0}).ok());
  ASSERT_TRUE(run_record_command({.input = "sim://office?seed=7", .file = whole, .seconds = 60.0}).ok());
  const auto ratio = static_cast<double>(std::filesystem::file_size(whole)) /
                     static_cast<double>(std::filesystem::file_size(half));
  EXPECT_NEAR(ratio, 1.8, 0.2);  // the beginning, which names the variables, is in both
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/recording/recording_plan.hpp"

#include <gmock/gmock.h>

#include <chrono>

namespace swiftlet {
namespace {

using Kind = InputUri::Kind;

InputUri input_of(Kind kind) {
  InputUri input;
  input.kind = kind;
  input.path = "flight.pcap";
  input.world = "office";
  return input;
}

RecordConfig into(const char* directory) {
  RecordConfig config;
  config.directory = directory;
  return config;
}

bool is_recorded(Kind kind, const RecordingWish& wish, const RecordConfig& config = into("/recordings")) {
  const Result<std::optional<RecordingPlan>> plan = plan_recording(input_of(kind), wish, config, HostTime{});
  EXPECT_TRUE(plan.ok());
  return plan && plan->has_value();
}

TEST(PlanRecording, RecordsLiveLinksByCustom) {
  for (const Kind kind : {Kind::kRadio, Kind::kUsbCable, Kind::kUdp}) EXPECT_TRUE(is_recorded(kind, {}));
  for (const Kind kind : {Kind::kSimulation, Kind::kFile}) EXPECT_FALSE(is_recorded(kind, {}));
}

TEST(PlanRecording, DoesAsItIsToldWhateverTheCustom) {
  RecordConfig off = into("/recordings");
  off.enabled = false;
  EXPECT_FALSE(is_recorded(Kind::kRadio, {}, off));
  EXPECT_FALSE(is_recorded(Kind::kRadio, {.asked = false, .refused = true, .file = ""}));
  EXPECT_TRUE(is_recorded(Kind::kRadio, {.asked = true, .refused = false, .file = ""}, off));
  EXPECT_TRUE(is_recorded(Kind::kSimulation, {.asked = true, .refused = false, .file = ""}, off));
}

TEST(PlanRecording, DoesNotRecordAFile) {
  const Result<std::optional<RecordingPlan>> plan = plan_recording(
      input_of(Kind::kFile), {.asked = true, .refused = false, .file = "copy.pcap"}, {}, HostTime{});
  ASSERT_FALSE(plan.ok());
  EXPECT_EQ(plan.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(plan.error().message, testing::HasSubstr("flight.pcap: is no vehicle"));
}

TEST(PlanRecording, TakesDirectoryAndLimitsFromTheConfiguration) {
  RecordConfig config = into("/recordings");
  config.max_file_mb = 3;
  config.max_total_mb = 7;
  const HostTime now{std::chrono::seconds(42)};
  const auto plan = plan_recording(input_of(Kind::kUdp), {}, config, now);
  ASSERT_TRUE(plan.ok() && plan->has_value());
  EXPECT_EQ((*plan)->file, "");
  EXPECT_EQ((*plan)->directory, "/recordings");
  EXPECT_EQ((*plan)->began, now);
  EXPECT_EQ((*plan)->max_file_bytes, 3'000'000U);
  EXPECT_EQ((*plan)->max_total_bytes, 7'000'000U);
}

TEST(PlanRecording, ASimulationWaitsForTheDiskAndALiveLinkDoesNot) {
  const RecordingWish wish{.asked = true, .refused = false, .file = "flight.pcap"};
  const auto simulation = plan_recording(input_of(Kind::kSimulation), wish, {}, HostTime{});
  const auto radio = plan_recording(input_of(Kind::kRadio), wish, {}, HostTime{});
  EXPECT_EQ((*simulation)->file, "flight.pcap");
  EXPECT_TRUE((*simulation)->source_can_wait);
  EXPECT_FALSE((*radio)->source_can_wait);
}

}  // namespace
}  // namespace swiftlet

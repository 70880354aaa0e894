// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/recording/recording_plan.hpp"

#include <gmock/gmock.h>

#include <chrono>

namespace swiftlet {
namespace {

constexpr const char* kRadio = "radio://0/80/2M/E7E7E7E7E7";
constexpr const char* kSimulation = "sim://office";

InputUri input_of(const char* uri) { return parse_input_uri(uri).value(); }

RecordConfig into(const char* directory) {
  RecordConfig config;
  config.directory = directory;
  return config;
}

bool is_recorded(const char* input, const RecordingWish& wish,
                 const RecordConfig& config = into("/recordings")) {
  const Result<std::optional<RecordingPlan>> plan = plan_recording(input_of(input), wish, config, HostTime{});
  EXPECT_TRUE(plan.ok());
  return plan && plan->has_value();
}

TEST(PlanRecording, RecordsLiveLinksByCustom) {
  for (const char* input : {kRadio, "usb://0", "udp://127.0.0.1"}) EXPECT_TRUE(is_recorded(input, {}));
  for (const char* input : {kSimulation, "flight.pcap"}) EXPECT_FALSE(is_recorded(input, {}));
}

TEST(PlanRecording, DoesAsItIsToldWhateverTheCustom) {
  RecordConfig off = into("/recordings");
  off.enabled = false;
  EXPECT_FALSE(is_recorded(kRadio, {}, off));
  EXPECT_FALSE(is_recorded(kRadio, {.asked = false, .refused = true, .file = ""}));
  EXPECT_TRUE(is_recorded(kRadio, {.asked = true, .refused = false, .file = ""}, off));
  EXPECT_TRUE(is_recorded(kSimulation, {.asked = true, .refused = false, .file = ""}, off));
}

TEST(PlanRecording, DoesNotRecordAFile) {
  const Result<std::optional<RecordingPlan>> plan = plan_recording(
      input_of("flight.pcap"), {.asked = true, .refused = false, .file = "copy.pcap"}, {}, HostTime{});
  ASSERT_FALSE(plan.ok());
  EXPECT_EQ(plan.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(plan.error().message, testing::HasSubstr("flight.pcap: is no vehicle"));
}

TEST(PlanRecording, TakesDirectoryAndLimitsFromTheConfiguration) {
  RecordConfig config = into("/recordings");
  config.max_file_mb = 3;
  config.max_total_mb = 7;
  const HostTime now{std::chrono::seconds(42)};
  const auto plan = plan_recording(input_of("udp://127.0.0.1"), {}, config, now);
  ASSERT_TRUE(plan.ok() && plan->has_value());
  EXPECT_EQ((*plan)->file, "");
  EXPECT_EQ((*plan)->directory, "/recordings");
  EXPECT_EQ((*plan)->began, now);
  EXPECT_EQ((*plan)->max_file_bytes, 3'000'000U);
  EXPECT_EQ((*plan)->max_total_bytes, 7'000'000U);
}

TEST(PlanRecording, ASimulationWaitsForTheDiskAndALiveLinkDoesNot) {
  const RecordingWish wish{.asked = true, .refused = false, .file = "flight.pcap"};
  const auto simulation = plan_recording(input_of(kSimulation), wish, {}, HostTime{});
  const auto radio = plan_recording(input_of(kRadio), wish, {}, HostTime{});
  EXPECT_EQ((*simulation)->file, "flight.pcap");
  EXPECT_TRUE((*simulation)->source_can_wait);
  EXPECT_FALSE((*radio)->source_can_wait);
}

}  // namespace
}  // namespace swiftlet

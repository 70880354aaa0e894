// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/doctor/vehicle_interview.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/firmware_link/scripted_clock.hpp"
#include "tests/firmware_link/scripted_vehicle.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;

class VehicleInterviewTest : public testing::Test {
 protected:
  VehicleInterviewTest() { link_.vehicle.variables = ScriptedVehicle::modern_variables(); }
  VehicleFacts ask() { return interview_vehicle(link_, clock_, cache_); }

  ScriptedLink link_;
  ScriptedClock clock_{link_};
  TocCache cache_;
};

TEST_F(VehicleInterviewTest, LearnsEverythingFromAGoodVehicle) {
  const VehicleFacts facts = ask();
  EXPECT_TRUE(facts.answered);
  EXPECT_EQ(facts.protocol, 12);
  EXPECT_EQ(facts.firmware, "2026.08");
  EXPECT_EQ(facts.device_type, "Crazyflie 2.1");
  EXPECT_EQ(facts.has_multiranger, true);
  EXPECT_EQ(facts.has_flow_deck, true);
  EXPECT_FALSE(facts.refusal.has_value());
  EXPECT_TRUE(facts.logs);
  EXPECT_EQ(facts.health.battery_mv, 1000);
  EXPECT_TRUE(facts.health.is_flying.has_value());
}

TEST_F(VehicleInterviewTest, LeavesNoLogBlockBehind) {
  static_cast<void>(ask());
  EXPECT_TRUE(link_.vehicle.blocks.empty());
}

TEST_F(VehicleInterviewTest, LearnsTheSameFromACachedTable) {
  static_cast<void>(ask());
  const std::size_t requests = link_.requests.size();
  EXPECT_TRUE(ask().logs);
  EXPECT_LT(link_.requests.size() - requests, requests / 2);
}

TEST_F(VehicleInterviewTest, EndsSoonWhereNobodyAnswers) {
  link_.reaches = [](std::int64_t) { return false; };
  const VehicleFacts facts = ask();
  EXPECT_FALSE(facts.answered);
  EXPECT_GE(link_.now_ms, 3'000);
  EXPECT_LT(link_.now_ms, 4'000);
}

TEST_F(VehicleInterviewTest, TellsWhatTheFirmwareLacksAndStillItsVersion) {
  std::erase_if(link_.vehicle.variables, [](const auto& variable) { return variable.group == "range"; });
  const VehicleFacts facts = ask();
  ASSERT_TRUE(facts.refusal.has_value());
  EXPECT_THAT(facts.refusal->message, HasSubstr("range.front"));
  EXPECT_EQ(facts.firmware, "2026.08");
  EXPECT_FALSE(facts.logs);
}

TEST_F(VehicleInterviewTest, EndsAtAFirmwareThatIsTooOldToBeAsked) {
  link_.vehicle.protocol = 3;
  const VehicleFacts facts = ask();
  EXPECT_EQ(facts.protocol, 3);
  EXPECT_TRUE(facts.refusal.has_value());
  EXPECT_LT(link_.now_ms, 2'000);
}

TEST_F(VehicleInterviewTest, DoesNotWaitForEverForHealthThatOlderFirmwareDoesNotTell) {
  std::erase_if(link_.vehicle.variables, [](const auto& variable) { return variable.group == "supervisor"; });
  const VehicleFacts facts = ask();
  EXPECT_TRUE(facts.logs);
  EXPECT_FALSE(facts.health.is_flying.has_value());
  EXPECT_LT(link_.now_ms, 6'000);
}

TEST_F(VehicleInterviewTest, GivesUpOnAVehicleThatFallsSilentHalfWay) {
  link_.reaches = [](std::int64_t now_ms) { return now_ms < 300; };
  link_.fate = [](std::span<const std::uint8_t> packet) {
    return is_on(packet, kLogTocTopic) ? ScriptedLink::Fate::kAnswerLost : ScriptedLink::Fate::kArrives;
  };
  const VehicleFacts facts = ask();
  EXPECT_TRUE(facts.answered);
  EXPECT_FALSE(facts.logs);
  EXPECT_LT(link_.now_ms, 21'000);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/live_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/scripted_vehicle.hpp"

namespace swiftlet {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Kind = VehicleEvent::Kind;

/// A session on a scripted link, as a sample source runs it.
class LiveSessionTest : public testing::Test {
 protected:
  LiveSessionTest() { link_.vehicle.variables = ScriptedVehicle::modern_variables(); }

  void run_until(std::int64_t end_ms) {
    while (link_.now_ms < end_ms) {
      if (const auto request = live_.next_request(host_ms(link_.now_ms))) {
        ASSERT_TRUE(link_.send(bytes_of(*request)).ok());
      }
      const Result<LinkFrame> frame = link_.receive(std::chrono::milliseconds(10));
      if (frame) on_frame(*frame);
      while (const auto event = live_.take_event()) events_.push_back(event->kind);
    }
  }
  void on_frame(const LinkFrame& frame) {
    const auto record = session_.on_frame(frame);
    if (frame.direction == LinkDirection::kToVehicle) return;
    live_.on_frame(frame, record);
    for (const CrtpPacket& reply : live_.take_cached_replies())
      static_cast<void>(session_.on_frame(received({reply.begin(), reply.end()}, frame.at)));
    if (record && record->block_id == 1)
      data_ms_.push_back(frame.at.time_since_epoch() / std::chrono::milliseconds(1));
  }
  void reboot() {
    link_.vehicle.blocks.clear();
    link_.booted_ms = link_.now_ms;
  }
  [[nodiscard]] std::int64_t first_data_after(std::int64_t ms) const {
    for (const std::int64_t at : data_ms_)
      if (at > ms) return at;
    return -1;
  }

  ScriptedLink link_;
  LogSession session_;
  TocCache cache_;
  LiveSession live_{session_, cache_};
  std::vector<Kind> events_;
  std::vector<std::int64_t> data_ms_;
};

TEST_F(LiveSessionTest, ConnectsAndMeasuresTheRoundTrip) {
  run_until(3000);
  EXPECT_THAT(events_, ElementsAre(Kind::kConnected));
  EXPECT_FALSE(live_.asks());
  EXPECT_EQ(live_.round_trip(), std::chrono::milliseconds(1));
  EXPECT_EQ(live_.health().battery_mv, 1000);
  EXPECT_GT(data_ms_.size(), 25U);
}

TEST_F(LiveSessionTest, ASilenceOfThreeSecondsIsOverWithinTwoSeconds) {
  link_.reaches = [](std::int64_t ms) { return ms < 5000 || ms >= 8000; };
  run_until(7900);
  link_.vehicle.blocks.clear();  // by the vehicle's watchdog
  run_until(12'000);
  EXPECT_LT(first_data_after(5000), 10'000);
  EXPECT_GE(first_data_after(5000), 8000);
  EXPECT_THAT(events_, ElementsAre(Kind::kConnected, Kind::kDataStopped, Kind::kConnected));
}

TEST_F(LiveSessionTest, AShortSilenceChangesNothing) {
  link_.reaches = [](std::int64_t ms) { return ms < 5000 || ms >= 5900; };
  run_until(8000);
  EXPECT_THAT(events_, ElementsAre(Kind::kConnected));
}

TEST_F(LiveSessionTest, RecognisesARebootedVehicleAndRestartsItsLog) {
  run_until(5000);
  reboot();
  link_.reaches = [](std::int64_t ms) { return ms < 5000 || ms >= 8000; };
  run_until(12'000);
  EXPECT_LT(first_data_after(5000), 10'000);
  EXPECT_THAT(events_, ElementsAre(Kind::kConnected, Kind::kDataStopped, Kind::kConnected, Kind::kRebooted));
}

TEST_F(LiveSessionTest, RecognisesAQuickRebootWithoutASilence) {
  run_until(5000);
  reboot();
  run_until(9000);
  EXPECT_THAT(events_, ElementsAre(Kind::kConnected, Kind::kDataStopped, Kind::kConnected, Kind::kRebooted));
  EXPECT_LT(first_data_after(5000), 7000);
}

TEST_F(LiveSessionTest, ReconnectingDownloadsNoTableOfContentsAgain) {
  run_until(5000);
  reboot();
  link_.requests.clear();
  run_until(9000);
  EXPECT_THAT(link_.requests, Not(Contains(hex("5c 02 00 00"))));
  EXPECT_THAT(link_.requests, Contains(hex("5c 03")));
}

TEST_F(LiveSessionTest, TellsThatAnotherProgramTalksToTheVehicle) {
  run_until(4000);
  EXPECT_THAT(events_, ElementsAre(Kind::kConnected));
  // As the vendor's client connects: what it asks is answered to all that receive.
  for (const char* answer : {"fc 07 00 00 00", "5d 06 04 00", "50 02 01 00 07 61 00 62 00"})
    on_frame(received(hex(answer), host_ms(link_.now_ms)));
  run_until(5000);
  EXPECT_THAT(events_, ElementsAre(Kind::kConnected, Kind::kOtherProgram));
  EXPECT_THAT(describe({Kind::kOtherProgram}), HasSubstr("another program talks to this vehicle"));
}

TEST_F(LiveSessionTest, TellsThatAnotherProgramStopsTheLog) {
  for (const std::int64_t ms : {5000, 10'000, 15'000}) {
    run_until(ms);
    link_.vehicle.blocks.clear();
  }
  run_until(20'000);
  EXPECT_EQ(std::ranges::count(events_, Kind::kOtherProgram), 1);
}

TEST_F(LiveSessionTest, TellsThatLogDataArrivesTwice) {
  run_until(3000);
  for (std::uint32_t i = 0; i < 30; ++i) {
    const std::uint32_t ms = 3000 + 100 * i;
    for (int copy = 0; copy < 2; ++copy)
      for (const Bytes& packet : link_.vehicle.data(ms)) on_frame(received(packet, host_ms(ms)));
  }
  run_until(7000);
  EXPECT_EQ(std::ranges::count(events_, Kind::kDoubledData), 1);
  EXPECT_THAT(describe({Kind::kDoubledData}), HasSubstr("another program talks to this vehicle"));
}

TEST_F(LiveSessionTest, AFewDoubledOrLatePacketsAreNoOtherProgram) {
  run_until(4000);
  for (int i = 0; i < 2; ++i) on_frame(received(hex("50 02 01 00 07 61 00 62 00"), host_ms(link_.now_ms)));
  for (int i = 0; i < 2; ++i)
    for (const Bytes& packet : link_.vehicle.data(4000)) on_frame(received(packet, host_ms(link_.now_ms)));
  run_until(60'000);
  EXPECT_THAT(events_, ElementsAre(Kind::kConnected));
}

TEST_F(LiveSessionTest, RestartsWhenOnlyTheSlowBlockArrives) {
  run_until(5000);
  link_.vehicle.blocks.erase(1);
  run_until(9000);
  EXPECT_THAT(events_, ElementsAre(Kind::kConnected, Kind::kDataStopped, Kind::kConnected));
  EXPECT_LT(first_data_after(5000), 7000);
}

TEST_F(LiveSessionTest, RestartsWhenOneOfTwoBlocksStops) {
  std::erase_if(link_.vehicle.variables, [](const auto& variable) { return variable.name == "info"; });
  run_until(5000);
  ASSERT_TRUE(link_.vehicle.blocks.contains(2));
  link_.vehicle.blocks.erase(2);
  run_until(9000);
  EXPECT_THAT(events_, Contains(Kind::kDataStopped));
  EXPECT_TRUE(link_.vehicle.blocks.contains(2));
}

TEST_F(LiveSessionTest, AfterASilenceInTheHandshakeAnotherVehicleMayAnswer) {
  link_.fate = [this](auto) {
    const bool is_silent = link_.requests.size() >= 10 && link_.now_ms < 7000;
    return is_silent ? ScriptedLink::Fate::kRequestLost : ScriptedLink::Fate::kArrives;
  };
  run_until(6900);
  ASSERT_THAT(link_.requests.back(), ElementsAre(0xFD, 0));
  run_until(9000);
  std::erase(events_, Kind::kReadingTable);
  EXPECT_THAT(events_, ElementsAre(Kind::kConnected));
  EXPECT_GT(data_ms_.size(), 10U);
}

TEST_F(LiveSessionTest, DiscardsTheRoundTripOfALostConnection) {
  link_.reaches = [](std::int64_t ms) { return ms < 5000; };
  run_until(8000);
  EXPECT_EQ(live_.round_trip(), Duration::zero());
}

TEST_F(LiveSessionTest, NamesMissingDecks) {
  link_.vehicle.params[0].value = 0;
  link_.vehicle.params[1].value = 0;
  run_until(2000);
  EXPECT_THAT(events_, ElementsAre(Kind::kConnected, Kind::kNoMultiranger, Kind::kNoFlowDeck));
}

TEST_F(LiveSessionTest, FailsIfTheFirstVehicleCannotBeUsed) {
  link_.vehicle.protocol = 3;
  run_until(500);
  ASSERT_TRUE(live_.failure().has_value());
}

TEST_F(LiveSessionTest, RetriesALaterVehicleThatCannotBeUsed) {
  run_until(3000);
  reboot();
  link_.vehicle.protocol = 3;
  run_until(8000);
  EXPECT_FALSE(live_.failure().has_value());
  EXPECT_THAT(events_, ElementsAre(Kind::kConnected, Kind::kDataStopped, Kind::kRefused));
  link_.vehicle.protocol = 13;
  run_until(15'000);
  EXPECT_THAT(events_, Contains(Kind::kProtocolNewer));
  EXPECT_GT(first_data_after(8000), 0);
}

}  // namespace
}  // namespace swiftlet

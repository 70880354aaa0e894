// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/log_handshake.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/scripted_vehicle.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Fate = ScriptedLink::Fate;

class LogHandshakeTest : public testing::Test {
 protected:
  LogHandshakeTest() { link_.vehicle.variables = ScriptedVehicle::modern_variables(); }

  /// Until log data flows, the handshake fails or half a minute is over.
  void run() { run(link_, session_, handshake_); }
  static void run(ScriptedLink& link, LogSession& session, LogHandshake& handshake) {
    while (!handshake.finished() && !handshake.failure() && link.now_ms < 30'000) {
      if (const auto request = handshake.next_request(host_ms(link.now_ms))) {
        ASSERT_TRUE(link.send(bytes_of(*request)).ok());
      }
      const Result<LinkFrame> frame = link.receive(std::chrono::milliseconds(10));
      if (!frame) continue;
      static_cast<void>(session.on_frame(*frame));
      if (frame->direction == LinkDirection::kFromVehicle) handshake.on_frame(frame->packet(), frame->at);
      for (const CrtpPacket& reply : handshake.take_cached_replies())
        static_cast<void>(session.on_frame(received({reply.begin(), reply.end()}, frame->at)));
    }
  }
  [[nodiscard]] std::vector<std::string> names_of(std::uint8_t block) const {
    std::vector<std::string> names;
    for (const auto& [type, variable] : link_.vehicle.blocks.at(block).entries)
      names.push_back(link_.vehicle.variables[variable].group + "." + link_.vehicle.variables[variable].name);
    return names;
  }
  void remove(const std::string& name) {
    std::erase_if(link_.vehicle.variables, [&name](const auto& v) { return v.group + "." + v.name == name; });
  }

  ScriptedLink link_;
  LogSession session_;
  TocCache cache_;
  LogHandshake handshake_{session_, cache_};
};

TEST_F(LogHandshakeTest, SendsRequestsInTheOrderOfTheWireDocument) {
  run();
  ASSERT_TRUE(handshake_.finished());
  ASSERT_EQ(link_.requests.size(), 4 + link_.vehicle.variables.size() + 5);
  EXPECT_EQ(link_.requests[0], hex("fd 00"));
  EXPECT_EQ(link_.requests[1], hex("dd 00"));
  EXPECT_EQ(link_.requests[2], hex("5d 05"));
  EXPECT_EQ(link_.requests[3], hex("5c 03"));
  EXPECT_EQ(link_.requests[4], hex("5c 02 00 00"));
  EXPECT_EQ(link_.requests[link_.requests.size() - 3], hex("5d 03 01 0a"));
  EXPECT_EQ(link_.requests.back(), hex("5d 03 03 64"));
  EXPECT_FALSE(handshake_.next_request(host_ms(link_.now_ms + 10'000)).has_value());
  EXPECT_EQ(handshake_.protocol(), 12);
}

TEST_F(LogHandshakeTest, StartsOneBlockWithAllVariablesIfTheFirmwareHasThem) {
  run();
  ASSERT_TRUE(handshake_.finished());
  ASSERT_EQ(link_.vehicle.blocks.size(), 2U);
  EXPECT_THAT(names_of(1), ElementsAre("stateEstimate.x", "stateEstimate.y", "stateEstimate.yaw",
                                       "range.front", "range.back", "range.left", "range.right",
                                       "range.zrange", "supervisor.info", "pm.vbatMV"));
  EXPECT_TRUE(link_.vehicle.blocks[1].running);
  EXPECT_TRUE(session_.blocks()[1].running);
  EXPECT_EQ(session_.blocks()[1].period, std::chrono::milliseconds(100));
  EXPECT_EQ(byte_count(session_.blocks()[1].entries), 26U);
}

TEST_F(LogHandshakeTest, LogsTheTiltBesideItAsOftenWhereTheFirmwareHasIt) {
  link_.vehicle.variables.push_back({"stateEstimate", "roll", LogType::kFloat});
  link_.vehicle.variables.push_back({"stateEstimate", "pitch", LogType::kFloat});
  run();
  ASSERT_TRUE(handshake_.finished());
  EXPECT_THAT(names_of(2), ElementsAre("stateEstimate.roll", "stateEstimate.pitch"));
  EXPECT_EQ(session_.blocks()[2].period, std::chrono::milliseconds(100));
  EXPECT_THAT(handshake_.essential_blocks(), ElementsAre(1)) << "samples do not need it";
}

TEST_F(LogHandshakeTest, LogsTheAltitudeBesideTheTiltWhereTheFirmwareHasIt) {
  link_.vehicle.variables.push_back({"stateEstimate", "roll", LogType::kFloat});
  link_.vehicle.variables.push_back({"stateEstimate", "pitch", LogType::kFloat});
  link_.vehicle.variables.push_back({"baro", "asl", LogType::kFloat});
  run();
  ASSERT_TRUE(handshake_.finished());
  EXPECT_THAT(names_of(2), ElementsAre("stateEstimate.roll", "stateEstimate.pitch", "baro.asl"));
}

TEST_F(LogHandshakeTest, StartsTwoBlocksOnOlderFirmware) {
  remove("supervisor.info");
  remove("radio.rssi");
  link_.vehicle.protocol = 4;
  run();
  ASSERT_TRUE(handshake_.finished());
  EXPECT_THAT(names_of(1),
              ElementsAre("stateEstimateZ.x", "stateEstimateZ.y", "stateEstimateZ.z", "pm.vbatMV"));
  EXPECT_THAT(names_of(2),
              ElementsAre("stateEstimate.qw", "stateEstimate.qx", "stateEstimate.qy", "stateEstimate.qz",
                          "range.front", "range.back", "range.left", "range.right", "range.zrange"));
}

TEST_F(LogHandshakeTest, RequestsTheHealthByTheNamesOfTheFirmware) {
  remove("pm.vbatMV");
  remove("supervisor.info");
  remove("radio.rssi");
  link_.vehicle.variables.push_back({"pm", "vbat", LogType::kFloat});
  link_.vehicle.variables.push_back({"sys", "isFlying", LogType::kUint8});
  run();
  ASSERT_TRUE(handshake_.finished());
  EXPECT_THAT(names_of(1), ElementsAre("stateEstimateZ.x", "stateEstimateZ.y", "stateEstimateZ.z", "pm.vbat",
                                       "sys.isFlying"));
}

TEST_F(LogHandshakeTest, RequestsNoVariableOfAnUnknownType) {
  const auto x = std::ranges::find(link_.vehicle.variables, "x", &ScriptedVehicle::Variable::name);
  x->type = LogType{};  // stateEstimate.x
  run();
  EXPECT_TRUE(handshake_.finished());
  for (const auto& [id, block] : link_.vehicle.blocks)
    for (const auto& [type, variable] : block.entries) EXPECT_NE(variable, 0) << int{id};
}

TEST_F(LogHandshakeTest, ReportsMissingLogVariables) {
  remove("stateEstimate.x");
  remove("stateEstimateZ.x");
  remove("range.left");
  run();
  ASSERT_TRUE(handshake_.failure().has_value());
  EXPECT_THAT(handshake_.failure()->message, HasSubstr("log variables stateEstimateZ.x range.left"));
}

TEST_F(LogHandshakeTest, RefusesFirmwareThatIsTooOldAndAcceptsNewer) {
  link_.vehicle.protocol = 3;
  run();
  ASSERT_TRUE(handshake_.failure().has_value());
  EXPECT_THAT(handshake_.failure()->message, HasSubstr("CRTP protocol 3"));

  LogSession session;
  TocCache cache;
  LogHandshake newer(session, cache);
  newer.on_frame(hex("fd 42 69 74 63 72 61 7a 65 20 43 72 61 7a 79 66 6c 69 65 00"), host_ms(0));
  newer.on_frame(hex("dd 00 0d 00 00 00"), host_ms(0));
  EXPECT_FALSE(newer.failure().has_value());
  EXPECT_EQ(newer.protocol(), 13);
}

TEST_F(LogHandshakeTest, RefusesAVehicleThatIsNoCrazyflie) {
  link_.vehicle.source = "Something else";
  run();
  ASSERT_TRUE(handshake_.failure().has_value());
  EXPECT_THAT(handshake_.failure()->message, HasSubstr("not a Crazyflie"));
}

TEST_F(LogHandshakeTest, RepeatsARequestAfterTwoHundredMilliseconds) {
  const auto first = handshake_.next_request(host_ms(1000));
  ASSERT_TRUE(first.has_value());
  EXPECT_FALSE(handshake_.next_request(host_ms(1199)).has_value());
  const auto second = handshake_.next_request(host_ms(1200));
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ((*second)[0], (*first)[0]);
  EXPECT_FALSE(handshake_.next_request(host_ms(1399)).has_value());
}

/// A handshake in which the first answers to one request are bad ones.
std::optional<Error> failure_after(ScriptedVehicle vehicle, const Bytes& bad, int times) {
  LogSession session;
  TocCache cache;
  LogHandshake handshake(session, cache);
  for (std::int64_t ms = 0; ms < 60'000 && !handshake.finished() && !handshake.failure(); ++ms) {
    const std::optional<CrtpPacket> request = handshake.next_request(host_ms(ms));
    if (!request) continue;
    static_cast<void>(session.on_frame(frame_of(LinkDirection::kToVehicle, host_ms(ms), bytes_of(*request))));
    const bool is_asked =
        (((*request)[0] ^ bad[0]) & 0xF3) == 0 && (bad[0] == 0xFD || (*request)[1] == bad[1]);
    std::optional<Bytes> reply = vehicle.answer(bytes_of(*request));
    if (is_asked && times-- > 0) reply = bad;
    if (!reply) continue;
    const LinkFrame frame = received(*reply, host_ms(ms));
    static_cast<void>(session.on_frame(frame));
    handshake.on_frame(frame.packet(), frame.at);
  }
  EXPECT_TRUE(handshake.finished() || handshake.failure());
  return handshake.failure();
}

TEST_F(LogHandshakeTest, AsksThreeTimesMoreBeforeItBelievesARefusal) {
  for (const char* bad :
       {"fd 4e 6f 6e 73 65 6e 73 65", "dd 00 02 00 00 00", "5d 05 00 08", "50 02", "5d 06 01 0c"}) {
    for (int times = 1; times <= 3; ++times)
      EXPECT_FALSE(failure_after(link_.vehicle, hex(bad), times)) << bad << ", " << times << " times";
    // Of an item that the table lacks: four times in each of four tables.
    EXPECT_TRUE(failure_after(link_.vehicle, hex(bad), std::string_view(bad) == "50 02" ? 16 : 4)) << bad;
  }
}

TEST_F(LogHandshakeTest, BelievesNoRefusalThatTheVehicleDoesNotRepeat) {
  for (const std::uint8_t header : {std::uint8_t{0xFD}, std::uint8_t{0xDD}}) {
    LogSession session;
    TocCache cache;
    LogHandshake handshake(session, cache);
    ScriptedVehicle vehicle = link_.vehicle;
    std::uint8_t bad_answers = 0;
    for (std::int64_t ms = 0; ms < 60'000 && !handshake.finished() && !handshake.failure(); ++ms) {
      const std::optional<CrtpPacket> request = handshake.next_request(host_ms(ms));
      if (!request) continue;
      std::optional<Bytes> reply = vehicle.answer(bytes_of(*request));
      const bool is_garbage = (((*request)[0] ^ header) & 0xF3) == 0 && bad_answers < 20;
      if (is_garbage) reply = Bytes{header, 0, 1, ++bad_answers};
      const LinkFrame frame = received(*reply, host_ms(ms));
      static_cast<void>(session.on_frame(frame));
      handshake.on_frame(frame.packet(), frame.at);
    }
    EXPECT_TRUE(handshake.finished()) << int{header} << ", " << handshake.failure()->message;
  }
}

TEST_F(LogHandshakeTest, ReadsATableAgainInWhichAVariableIsMissing) {
  std::set<std::string> undamaged{"stateEstimate.x", "stateEstimateZ.x"};
  for (std::int64_t ms = 0; ms < 60'000 && !handshake_.finished() && !handshake_.failure(); ++ms) {
    const std::optional<CrtpPacket> request = handshake_.next_request(host_ms(ms));
    if (!request) continue;
    Bytes reply = *link_.vehicle.answer(bytes_of(*request));
    const std::optional<TocItem> item = read_toc_item(reply);
    if (item && undamaged.erase(item->name) > 0) reply[5] ^= 1U;
    const LinkFrame frame = received(reply, host_ms(ms));
    static_cast<void>(session_.on_frame(frame));
    handshake_.on_frame(frame.packet(), frame.at);
  }
  EXPECT_TRUE(undamaged.empty());
  EXPECT_TRUE(handshake_.finished());
}

TEST_F(LogHandshakeTest, ReadsATableAgainWhoseLengthWasDamaged) {
  bool was_damaged = false;
  for (std::int64_t ms = 0; ms < 60'000 && !handshake_.finished() && !handshake_.failure(); ++ms) {
    const std::optional<CrtpPacket> request = handshake_.next_request(host_ms(ms));
    if (!request) continue;
    Bytes reply = *link_.vehicle.answer(bytes_of(*request));
    if (read_toc_info(reply) && !std::exchange(was_damaged, true)) reply[3] = 0xDE;
    const LinkFrame frame = received(reply, host_ms(ms));
    static_cast<void>(session_.on_frame(frame));
    handshake_.on_frame(frame.packet(), frame.at);
  }
  EXPECT_TRUE(was_damaged);
  EXPECT_TRUE(handshake_.finished());
}

TEST_F(LogHandshakeTest, IgnoresRepliesToOtherItemsAndBlocks) {
  run();
  ASSERT_TRUE(handshake_.finished());
  LogSession session;
  TocCache cache;
  LogHandshake handshake(session, cache);
  handshake.on_frame(hex("5d 03 01 00"), host_ms(0));
  handshake.on_frame(hex("50 02"), host_ms(0));
  handshake.on_frame(hex("52 01 00 00 00 00"), host_ms(0));
  EXPECT_FALSE(handshake.failure().has_value());
  EXPECT_EQ((*handshake.next_request(host_ms(0)))[0], 0xFD);
}

TEST_F(LogHandshakeTest, ReportsAFullLog) {
  link_.vehicle.room = 3;
  run();
  ASSERT_TRUE(handshake_.failure().has_value());
  EXPECT_THAT(handshake_.failure()->message, HasSubstr("its log is full"));
}

TEST_F(LogHandshakeTest, RemakesABlockThatVanishedBeforeItsStart) {
  bool rebooted = false;
  link_.fate = [this, &rebooted](std::span<const std::uint8_t> request) {
    if (request[0] == 0x5D && request[1] == 3 && !rebooted) {
      rebooted = true;
      link_.vehicle.blocks.clear();
    }
    return Fate::kArrives;
  };
  run();
  EXPECT_TRUE(handshake_.finished());
  EXPECT_EQ(names_of(1).size(), 10U);
}

TEST_F(LogHandshakeTest, ASecondSessionTakesTheTableOfContentsFromTheCache) {
  run();
  const std::size_t requests = link_.requests.size();
  LogSession session;
  LogHandshake again(session, cache_);
  run(link_, session, again);
  ASSERT_TRUE(again.finished());
  EXPECT_EQ(link_.requests.size(), 2 * requests - link_.vehicle.variables.size());
  for (std::uint16_t id = 0; id < link_.vehicle.variables.size(); ++id) EXPECT_TRUE(session.toc().has(id));
  EXPECT_EQ(session.blocks()[1].entries.size(), 10U);
}

TEST_F(LogHandshakeTest, DiscardsAWrongCacheEntry) {
  std::vector<TocItem> wrong;
  for (std::uint16_t id = 0; id < link_.vehicle.variables.size(); ++id) {
    const ScriptedVehicle::Variable& v = link_.vehicle.variables[id];
    wrong.push_back(
        {static_cast<std::uint16_t>(id + 500), static_cast<std::uint8_t>(v.type), v.group + "." + v.name});
  }
  cache_.store(kLogTocTopic.port, {static_cast<std::uint16_t>(wrong.size()), 0x04030201}, wrong);
  run();
  ASSERT_TRUE(handshake_.finished());
  EXPECT_EQ(names_of(1).size(), 10U);
}

TEST_F(LogHandshakeTest, LeavesOutTheSlowBlockIfThereIsNoRoom) {
  link_.fate = [this](std::span<const std::uint8_t> request) {
    if (request[0] == 0x5D && request[1] == 6 && request[2] == 3) link_.vehicle.room = 0;
    return Fate::kArrives;
  };
  run();
  ASSERT_TRUE(handshake_.finished());
  EXPECT_TRUE(link_.vehicle.blocks[1].running);
  EXPECT_FALSE(link_.vehicle.blocks[3].running);
}

TEST_F(LogHandshakeTest, SurvivesTheLossOfEachRequestOrAnswer) {
  run();
  const std::size_t requests = link_.requests.size();
  for (const Fate fate : {Fate::kRequestLost, Fate::kAnswerLost}) {
    for (std::size_t lost = 0; lost < requests; ++lost) {
      ScriptedLink link;
      link.vehicle.variables = ScriptedVehicle::modern_variables();
      std::size_t count = 0;
      link.fate = [&](auto) { return count++ == lost ? fate : Fate::kArrives; };
      LogSession session;
      TocCache cache;
      LogHandshake handshake(session, cache);
      run(link, session, handshake);
      ASSERT_TRUE(handshake.finished()) << "lost " << lost;
      ASSERT_EQ(link.vehicle.blocks.at(1).entries.size(), 10U) << "lost " << lost;
      ASSERT_EQ(session.blocks()[1].entries.size(), 10U) << "lost " << lost;
      ASSERT_TRUE(link.vehicle.blocks.at(1).running);
    }
  }
}

TEST_F(LogHandshakeTest, AcceptsAnswersThatTakeLongerThanTheRepetitionPeriod) {
  for (const int delay_ms : {210, 390, 700}) {
    ScriptedVehicle vehicle = link_.vehicle;
    LogSession session;
    TocCache cache;
    LogHandshake handshake(session, cache);
    std::deque<LinkFrame> replies;
    for (int ms = 0; ms < 60'000 && !handshake.finished() && !handshake.failure(); ms += 10) {
      if (const auto request = handshake.next_request(host_ms(ms))) {
        const Bytes packet(request->begin(), request->end());
        static_cast<void>(session.on_frame(sent(packet, host_ms(ms))));
        replies.push_back(received(*vehicle.answer(packet), host_ms(ms + delay_ms)));
      }
      for (; !replies.empty() && replies.front().at <= host_ms(ms); replies.pop_front()) {
        static_cast<void>(session.on_frame(replies.front()));
        handshake.on_frame(replies.front().packet(), replies.front().at);
      }
    }
    EXPECT_TRUE(handshake.finished()) << delay_ms;
    EXPECT_EQ(vehicle.blocks[1].entries.size(), 10U) << delay_ms;
    EXPECT_EQ(session.blocks()[1].entries.size(), 10U) << delay_ms;
  }
}

TEST_F(LogHandshakeTest, DoesNotRefuseAVehicleForPacketLoss) {
  link_.fate = [this](std::span<const std::uint8_t> request) {
    const bool is_append = request[0] == 0x5D && request[1] == 7;
    return is_append && link_.now_ms < 15'000 ? Fate::kAnswerLost : Fate::kArrives;
  };
  run();
  EXPECT_FALSE(handshake_.failure().has_value());
  EXPECT_TRUE(handshake_.finished());
}

TEST_F(LogHandshakeTest, SucceedsOverABadLink) {
  std::mt19937 random(5);
  link_.fate = [&random](auto) {
    const auto draw = random() % 10;
    return draw < 2 ? Fate::kRequestLost : draw < 4 ? Fate::kAnswerLost : Fate::kArrives;
  };
  run();
  ASSERT_TRUE(handshake_.finished());
  EXPECT_EQ(names_of(1).size(), 10U);
  EXPECT_EQ(session_.blocks()[1].entries.size(), 10U);
}

}  // namespace
}  // namespace swiftlet

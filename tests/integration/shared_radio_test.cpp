// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "firmware_link/crtp/crtp_packet.hpp"
#include "tests/support/shared_flight.hpp"

// One emulated Crazyradio, in simulated time: samples for the map, and a client on the loopback.

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;
using Kind = VehicleEvent::Kind;

constexpr std::array<std::uint16_t, 3> kVariables{0, 1, 2};  // floats of the log table
constexpr std::array<std::uint8_t, 3> kBlocks{1, 2, 3};      // the numbers of the owner's, too

class SharedRadio : public SharedFlight {
 public:
  /// Until the first sample, and some more.
  void begin() {
    fly(seconds(20), [this] { return !samples.empty(); });
    ASSERT_FALSE(samples.empty());
    fly(seconds(3));
  }
  /// Ten a second, none missing, none twice, one segment.
  void expect_steady() const {
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const Duration step = samples[i].measured_at - samples[i - 1].measured_at;
      ASSERT_GE(step, milliseconds(90)) << "sample " << i;
      ASSERT_LE(step, milliseconds(110)) << "sample " << i;
    }
    EXPECT_EQ(source->report().counters.gaps, 0U);
    EXPECT_EQ(source->report().counters.segments, 1U);
  }
  [[nodiscard]] long count(Kind kind) const { return std::ranges::count(events, kind, &VehicleEvent::kind); }
  /// Packets that reached the vehicle on that port, without their link bits.
  [[nodiscard]] std::vector<FlightClient::Packet> received_by_vehicle(unsigned port_number) const {
    std::vector<FlightClient::Packet> packets;
    for (const PacketBytes& bytes : flight.receiver.uplink()) {
      if (bytes[0] >> 4U != port_number) continue;
      packets.emplace_back(bytes.begin(), bytes.end());
      packets.back()[0] |= 0x0CU;
    }
    return packets;
  }
};

std::vector<std::uint8_t> setpoint(std::uint32_t number) {
  return {0x3C, low_byte(number), high_byte(number), low_byte(number >> 16U), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
          0};
}

TEST(SharedRadioTest, AClientConnectsAsTheVendorsLibraryDoesAndCostsNoSample) {
  SharedRadio shared;
  shared.begin();
  FlightClient& client = shared.add_client();
  client.connect();
  shared.fly(seconds(30), [&] { return client.is_idle(); });
  EXPECT_TRUE(client.is_idle());
  EXPECT_EQ(client.unanswered(), 0U);
  EXPECT_TRUE(client.strange().empty()) << "first on " << int(client.strange().front()[0]);
  EXPECT_GT(client.table_size(kLogTocTopic.port), 300U);
  EXPECT_EQ(client.items_received(kLogTocTopic.port), client.table_size(kLogTocTopic.port));
  EXPECT_EQ(client.items_received(kParamTocTopic.port), client.table_size(kParamTocTopic.port));
  EXPECT_EQ(shared.count(Kind::kClientConnected), 1);
  shared.expect_steady();
}

TEST(SharedRadioTest, AClientMayConnectWhileTheLogIsSetUp) {
  SharedRadio shared;
  FlightClient& client = shared.add_client();
  client.connect();
  shared.fly(seconds(30), [&] { return client.is_idle() && !client.console().empty(); });
  EXPECT_EQ(client.unanswered(), 0U);
  EXPECT_TRUE(client.strange().empty());
  EXPECT_EQ(client.items_received(kLogTocTopic.port), client.table_size(kLogTocTopic.port));
  shared.fly(seconds(5));
  shared.expect_steady();
}

TEST(SharedRadioTest, BothSidesUseTheSameBlockNumbersAndHaveTheirOwnData) {
  SharedRadio shared;
  shared.begin();
  FlightClient& client = shared.add_client();
  for (const std::uint8_t block : kBlocks) client.start_block(block, kVariables, 5);
  shared.fly(seconds(10));
  for (const std::uint8_t block : kBlocks) {
    ASSERT_TRUE(client.data().contains(block));
    EXPECT_NEAR(static_cast<double>(client.data().at(block).size()), 200.0, 5.0);
    for (const FlightClient::Packet& packet : client.data().at(block)) ASSERT_EQ(packet.size(), 5U + 12U);
  }
  EXPECT_EQ(client.data().size(), 3U) << "the owner's blocks are not the client's";
  client.ask(log_block_request(LogCommand::kDelete, 1));
  shared.fly(seconds(5));
  EXPECT_EQ(client.answer_to(LogCommand::kDelete, 1), LogError::kNone);
  EXPECT_LT(client.data().at(1).size(), 210U);
  EXPECT_GT(client.data().at(2).size(), 290U);
  shared.expect_steady();
}

TEST(SharedRadioTest, AClientsResetDeletesItsOwnBlocksOnly) {
  SharedRadio shared;
  shared.begin();
  FlightClient& client = shared.add_client();
  for (int i = 0; i < 20; ++i) {
    for (const std::uint8_t block : kBlocks) client.start_block(block, kVariables, 10);
    shared.fly(seconds(1));
    client.ask(log_reset_request());
    shared.fly(milliseconds(300));
    EXPECT_EQ(client.answer_to(LogCommand::kCreate, 1), LogError::kNone);
    EXPECT_EQ(client.answer_to(LogCommand::kReset, 0), LogError::kNone);
  }
  EXPECT_EQ(client.unanswered(), 0U);
  const std::size_t before = client.data().at(1).size();
  shared.fly(seconds(2));
  EXPECT_EQ(client.data().at(1).size(), before);
  shared.expect_steady();
}

TEST(SharedRadioTest, AClientThatTakesAllBlocksLeavesTheOwnersTheirRoom) {
  SharedRadio shared;
  shared.begin();
  FlightClient& client = shared.add_client();
  for (std::uint8_t block = 0; block < 20; ++block) client.start_block(block, kVariables, 10);
  shared.fly(seconds(2));
  EXPECT_EQ(client.answer_to(LogCommand::kCreate, 12), LogError::kNone);
  EXPECT_EQ(client.answer_to(LogCommand::kCreate, 13), LogError::kNoRoom);
  EXPECT_EQ(client.answer_to(LogCommand::kStart, 13), LogError::kUnknown);
  EXPECT_EQ(client.data().size(), 13U);
  shared.expect_steady();
  // After a restart of the vehicle both want everything at once.
  shared.flight.vehicle.reboot();
  shared.every(milliseconds(300), [&] {
    if (client.is_idle())
      for (std::uint8_t block = 0; block < 20; ++block) client.start_block(block, kVariables, 10);
  });
  const std::size_t samples = shared.samples.size();
  shared.fly(seconds(20));
  EXPECT_GT(shared.samples.size(), samples + 100);
}

TEST(SharedRadioTest, AClientThatTakesAllVariablesLeavesTheOwnersTheirRoom) {
  SharedRadio shared;
  shared.begin();
  FlightClient& client = shared.add_client();
  for (std::uint8_t block = 0; block < 13; ++block)  // bytes: the most that a block takes
    for (const LogCommand command : {LogCommand::kCreate, LogCommand::kAppend}) {
      CrtpPacket request = log_block_request(command, block);
      while (add_log_entry(request, 1, 0)) {
      }
      client.ask(request);
    }
  shared.fly(seconds(2));
  EXPECT_EQ(client.answer_to(LogCommand::kAppend, 4), LogError::kNone);
  EXPECT_EQ(client.answer_to(LogCommand::kAppend, 5), LogError::kNoRoom);
  EXPECT_EQ(client.answer_to(LogCommand::kCreate, 6), LogError::kNoRoom);
  EXPECT_EQ(client.unanswered(), 0U);
  shared.expect_steady();
}

class LossySharedRadioTest : public testing::TestWithParam<double> {};

TEST_P(LossySharedRadioTest, NoSetpointIsLostOrReordered) {
  SharedRadio shared;
  shared.flight.receiver.losses = {.packet = GetParam(), .ack = GetParam(), .retries_share_fate = true};
  shared.begin();
  FlightClient& client = shared.add_client();
  client.connect();
  std::vector<FlightClient::Packet> sent;
  shared.every(milliseconds(10), [&] {
    if (sent.size() == 6000) return;
    sent.push_back(setpoint(static_cast<std::uint32_t>(sent.size())));
    client.send(sent.back());
  });
  shared.fly(seconds(62));
  EXPECT_EQ(sent.size(), 6000U);
  EXPECT_EQ(shared.received_by_vehicle(3), sent);
  EXPECT_EQ(client.unanswered(), 0U);
  shared.expect_steady();
}

INSTANTIATE_TEST_SUITE_P(Losses, LossySharedRadioTest, testing::Values(0.0, 0.2));

TEST(SharedRadioTest, TheOwnerSendsNoSetpoint) {
  SharedRadio shared;
  shared.begin();
  FlightClient& client = shared.add_client();
  client.connect();
  shared.fly(seconds(10));
  for (const unsigned port : {3U, 7U, 8U}) EXPECT_TRUE(shared.received_by_vehicle(port).empty());
}

TEST(SharedRadioTest, AFloodEndsNeitherTheMapNorTheSetpoints) {
  SharedRadio shared;
  shared.begin();
  FlightClient& client = shared.add_client();
  std::mt19937 random(7);
  shared.every(milliseconds(1), [&] {
    for (int i = 0; i < 5; ++i) {
      std::vector<std::uint8_t> packet(1 + random() % 40);
      for (std::uint8_t& byte : packet) byte = static_cast<std::uint8_t>(random());
      const unsigned port_number = packet[0] >> 4U;
      const bool steers = port_number == 3 || port_number == 7 || port_number == 8;
      if (!steers && packet[0] != 0xF4) client.send(packet);  // which is goodbye
    }
  });
  std::vector<FlightClient::Packet> sent;
  shared.every(milliseconds(10), [&] {
    sent.push_back(setpoint(static_cast<std::uint32_t>(sent.size())));
    client.send(sent.back());
  });
  shared.fly(seconds(20));
  const std::vector<FlightClient::Packet> received = shared.received_by_vehicle(3);
  ASSERT_GE(received.size() + 2, sent.size());
  EXPECT_TRUE(std::equal(received.begin(), received.end(), sent.begin()));
  EXPECT_GT(shared.source->live_status()->sharing.counters.requests_dropped, 1000U);
  shared.expect_steady();
}

TEST(SharedRadioTest, AFloodOfSetpointsDoesNotKeepTheOwnerFromConnectingAgain) {
  SharedRadio shared;
  shared.begin();
  FlightClient& client = shared.add_client();
  shared.every(milliseconds(1), [&] {
    for (std::uint32_t i = 0; i < 5; ++i) client.send(setpoint(i));
  });
  shared.fly(seconds(2));
  shared.expect_steady();
  shared.flight.vehicle.reboot();
  const std::size_t samples = shared.samples.size();
  shared.fly(seconds(20));
  EXPECT_GT(shared.samples.size(), samples + 100);
}

TEST(SharedRadioTest, AClientKilledInTheMiddleOfARequestLeavesNothingBehind) {
  SharedRadio shared;
  shared.begin();
  FlightClient& client = shared.add_client();
  for (const std::uint8_t block : kBlocks) client.start_block(block, kVariables, 1);
  shared.fly(seconds(1));
  client.send(log_block_request(LogCommand::kCreate, 4));
  client.send(toc_item_request(kLogTocTopic, 3));
  shared.clients.front().reset();
  shared.fly(seconds(5));
  EXPECT_EQ(shared.count(Kind::kClientGone), 1);
  const std::size_t queued = shared.flight.receiver.queued_log().size();
  shared.fly(seconds(10));
  EXPECT_LE(shared.flight.receiver.queued_log().size() - queued, 215U) << "its blocks still run";
  FlightClient& next = shared.add_client();
  next.connect();
  shared.fly(seconds(20), [&] { return next.is_idle(); });
  EXPECT_EQ(next.unanswered(), 0U);
  EXPECT_TRUE(next.strange().empty());
  shared.expect_steady();
}

TEST(SharedRadioTest, ASecondClientIsRefusedInOneLineUntilTheFirstIsGone) {
  SharedRadio shared;
  shared.begin();
  FlightClient& first = shared.add_client();
  first.connect();
  shared.fly(milliseconds(500));
  FlightClient& second = shared.add_client();
  for (int i = 0; i < 5; ++i) second.ask(source_request());
  constexpr std::array<std::uint8_t, 1> kScan{0xFF};
  second.send(kScan);
  shared.fly(seconds(12), [&] { return second.is_idle(); });
  EXPECT_EQ(second.unanswered(), 5U);
  EXPECT_EQ(second.nulls(), 0U);
  EXPECT_EQ(shared.count(Kind::kClientRefused), 1);
  constexpr std::array<std::uint8_t, 1> kGoodbye{0xF4};
  first.send(kGoodbye);
  shared.clients.front().reset();
  shared.fly(milliseconds(100));
  second.send(kScan);
  second.ask(source_request());
  shared.fly(seconds(1));
  EXPECT_EQ(second.unanswered(), 5U);
  EXPECT_EQ(second.nulls(), 1U);
  EXPECT_EQ(shared.count(Kind::kClientConnected), 2);
  shared.expect_steady();
}

TEST(SharedRadioTest, SetpointsThatCannotBeSentAreNotSentLate) {
  SharedRadio shared;
  shared.begin();
  FlightClient& client = shared.add_client();
  std::uint32_t number = 0;
  shared.every(milliseconds(10), [&] { client.send(setpoint(number++)); });
  shared.fly(seconds(2));
  shared.flight.receiver.in_range = false;
  shared.fly(seconds(4));
  const std::size_t received = shared.received_by_vehicle(3).size();
  const std::uint32_t then = number;
  shared.flight.receiver.in_range = true;
  shared.fly(seconds(2));
  const std::vector<FlightClient::Packet> packets = shared.received_by_vehicle(3);
  ASSERT_GT(packets.size(), received + 100);
  const std::uint32_t first = packets[received][1] + 256U * packets[received][2];
  EXPECT_GE(first + 10, then);
}

TEST(SharedRadioTest, AClientWhoseLogBlocksAreGoneIsToldOnce) {
  SharedRadio shared;
  shared.begin();
  FlightClient& client = shared.add_client();
  client.start_block(1, kVariables, 10);
  shared.fly(seconds(2));
  shared.flight.receiver.in_range = false;
  shared.fly(seconds(2));
  EXPECT_EQ(client.console().find("swiftletd: "), std::string::npos);
  shared.flight.receiver.in_range = true;
  shared.fly(seconds(5));
  EXPECT_NE(
      client.console().find("swiftletd: the log had to begin anew, your blocks are gone; connect again\n"),
      std::string::npos);
  EXPECT_EQ(shared.count(Kind::kClientBlocksLost), 1);
  const std::size_t before = client.data().at(1).size();
  client.start_block(1, kVariables, 10);
  shared.fly(seconds(2));
  EXPECT_GT(client.data().at(1).size(), before + 15);
}

TEST(SharedRadioTest, AClientThatLogsMoreThanTheLinkCarriesDoesNotEndTheMap) {
  SharedRadio shared;
  shared.begin();
  FlightClient& client = shared.add_client();
  for (std::uint8_t block = 0; block < 13; ++block) client.start_block(block, kVariables, 1);
  shared.fly(seconds(3));
  const std::size_t before = shared.samples.size();
  shared.fly(seconds(30));
  RecordProperty("samples_in_30_s", static_cast<int>(shared.samples.size() - before));
  EXPECT_GT(shared.flight.receiver.dropped(), 1000U);
  EXPECT_GT(shared.samples.size() - before, 100U);
  EXPECT_EQ(shared.source->report().counters.segments, 1U);
  EXPECT_EQ(shared.count(Kind::kDataStopped), 0);
}

TEST(SharedRadioTest, TenMinutesWithAClientThatLogsAllTheSameBringEverySample) {
  SharedRadio shared;
  shared.begin();
  FlightClient& client = shared.add_client();
  client.connect();
  shared.fly(seconds(30), [&] { return client.is_idle(); });
  const std::array<std::uint16_t, 3> pose{client.log_variable("stateEstimate.x"),
                                          client.log_variable("stateEstimate.y"),
                                          client.log_variable("stateEstimate.yaw")};
  client.start_block(7, pose, 1);
  shared.fly(minutes(10));
  EXPECT_EQ(client.unanswered(), 0U);
  EXPECT_TRUE(client.strange().empty());
  EXPECT_NEAR(static_cast<double>(client.data().at(7).size()), 60'000.0, 100.0);
  EXPECT_GT(client.pongs(), 600U);
  EXPECT_LE(client.pings() - client.pongs(), 1U);
  EXPECT_GT(shared.samples.size(), 5990U);
  shared.expect_steady();
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/log_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "firmware_link/capture/replay_link.hpp"
#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/synthetic_capture.hpp"
#include "tests/support/reference_data.hpp"

namespace swiftlet {
namespace {

void feed_all(LogSession& session, const std::vector<LinkFrame>& frames) {
  for (const LinkFrame& frame : frames) EXPECT_FALSE(session.on_frame(frame).has_value());
}

TEST(LogSession, DecodesTheMeasuredPacketByWhatTheBlockHolds) {
  LogSession session;
  const std::vector<const char*> names{"x", "y", "z", "yaw"};
  for (std::size_t i = 0; i < names.size(); ++i)
    static_cast<void>(session.on_frame(received(
        toc_item_reply(static_cast<std::uint16_t>(0x3E + i), LogType::kFloat, "stateEstimate", names[i]))));
  feed_all(session,
           {sent(hex("5d 06 01 07 3e 00 07 3f 00 07 40 00 07 41 00")), received(hex("5d 06 01 00"))});
  const LinkFrame frame =
      received(hex("52 01 9e 12 00 | 00 00 80 3f | f2 90 4a af | 05 00 00 3f | 5f 72 24 35"), host_ms(7));
  const std::optional<LogRecord> record = session.on_frame(frame);
  ASSERT_TRUE(record.has_value());
  EXPECT_EQ(record->block_id, 1);
  EXPECT_EQ(record->at, device_ms(4766));
  EXPECT_EQ(record->received, host_ms(7));
  ASSERT_EQ(record->entry_count, 4U);
  EXPECT_EQ(session.name_of(*record, 3), "stateEstimate.yaw");
  EXPECT_EQ(record->value(0), 1.0);
  EXPECT_NEAR(record->value(1), 0.0, 1e-9);
  EXPECT_NEAR(record->value(2), 0.5, 1e-6);
  EXPECT_NEAR(record->value(3), 0.0, 1e-5);
}

TEST(LogSession, LearnsFromTheRightDirectionOnly) {
  LogSession session;
  const SyntheticCapture capture;
  std::vector<LinkFrame> reversed = capture.handshake();
  for (LinkFrame& frame : reversed)
    frame.direction = frame.direction == LinkDirection::kToVehicle ? LinkDirection::kFromVehicle
                                                                   : LinkDirection::kToVehicle;
  feed_all(session, reversed);
  EXPECT_FALSE(session.toc().has(0));
  EXPECT_FALSE(session.blocks()[1].exists);
  feed_all(session, capture.handshake());
  EXPECT_TRUE(session.on_frame(capture.data(0)).has_value());
}

TEST(LogSession, ARequestReceivedTwiceIsHarmless) {
  LogSession session;
  for (const LinkFrame& frame : SyntheticCapture{}.handshake()) {
    if (frame.direction == LinkDirection::kToVehicle) session.on_request(frame.packet());
    static_cast<void>(session.on_frame(frame));
  }
  const auto record = session.on_frame(SyntheticCapture{}.data(3));
  ASSERT_TRUE(record.has_value());
  EXPECT_EQ(record->entry_count, 7U);
}

TEST(LogSession, CountsWhatItCannotRead) {
  LogSession session;
  feed_all(session, SyntheticCapture{}.handshake());
  feed_all(session, {received(hex("52 01 00 00 00 01 02")), received(hex("52 01 00"))});
  EXPECT_EQ(session.unreadable().misfit, 2U);
  feed_all(session, {received(hex("52 09 00 00 00 01 02"))});
  EXPECT_EQ(session.unreadable().unknown_block, 1U);
}

TEST(LogSession, UsesTheDescriptionOnlyForBlocksWithoutNames) {
  BlockDescription description;
  description.blocks[1].variables = {{"described.a", LogType::kFloat}};
  description.blocks[2].variables = {{"described.b", LogType::kUint16}};
  LogSession session;
  session.describe(description);
  feed_all(session, SyntheticCapture{}.handshake());
  const auto own = session.on_frame(SyntheticCapture{}.data(0));
  ASSERT_TRUE(own.has_value());
  EXPECT_FALSE(own->described);
  EXPECT_FALSE(session.used_description());
  const LinkFrame frame = received(LogPacket(2, 5).u16(77).bytes());
  const auto described = session.on_frame(frame);
  ASSERT_TRUE(described.has_value());
  EXPECT_TRUE(session.used_description());
  EXPECT_EQ(session.name_of(*described, 0), "described.b");
  EXPECT_EQ(described->value(0), 77.0);
  feed_all(session, {received(LogPacket(2, 5).u32(1).bytes())});
  EXPECT_EQ(session.unreadable().misfit, 1U);
}

TEST(LogSession, AcceptsNamesAfterTheBlocks) {
  const std::vector<LinkFrame> frames = SyntheticCapture{}.handshake();
  LogSession session;
  for (std::size_t i = frames.size() - 4; i < frames.size(); ++i)
    static_cast<void>(session.on_frame(frames[i]));
  EXPECT_FALSE(session.on_frame(SyntheticCapture{}.data(0)).has_value());
  feed_all(session, {frames.begin(), frames.end() - 4});
  // The capture begins with a reset, which came later here: make the block again.
  for (std::size_t i = frames.size() - 4; i < frames.size(); ++i)
    static_cast<void>(session.on_frame(frames[i]));
  EXPECT_TRUE(session.on_frame(SyntheticCapture{}.data(1)).has_value());
}

TEST(LogSession, PacketsThatWaitedThroughASilenceAreNoReboot) {
  const SyntheticCapture capture;
  LogSession session;
  feed_all(session, capture.handshake());
  // Its time by the vehicle's clock; received that many milliseconds later.
  const auto boot_of = [&](int i, std::int64_t later_ms) {
    LinkFrame frame = capture.data(i);
    frame.at += std::chrono::milliseconds(later_ms);
    const std::optional<LogRecord> record = session.on_frame(frame);
    EXPECT_TRUE(record.has_value());
    return record ? record->boot : 99U;
  };
  for (int i = 0; i < 5; ++i) EXPECT_EQ(boot_of(i, 1), 0U);
  for (int i = 5; i < 13; ++i) EXPECT_EQ(boot_of(i, 6000 - 100L * i), 0U);
  feed_all(session, capture.handshake());
  EXPECT_EQ(boot_of(60, 1), 0U);
  feed_all(session, capture.handshake());
  EXPECT_EQ(boot_of(10, 20'000), 1U);
}

/// A data packet of the capture, with another stamp.
LinkFrame stamped(LinkFrame frame, std::uint32_t counter_ms) {
  for (std::size_t i = 0; i < 3; ++i) frame.bytes[2 + i] = static_cast<std::uint8_t>(counter_ms >> (8 * i));
  return frame;
}

TEST(LogSession, OnlyItsOwnBlocksMoveTheClock) {
  const SyntheticCapture capture;
  LogSession session;
  feed_all(session, capture.handshake());
  const auto expect_time = [&](int i) {
    const std::optional<LogRecord> record = session.on_frame(capture.data(i));
    ASSERT_TRUE(record.has_value());
    EXPECT_EQ(record->at, device_ms(capture.first_ms + 100L * i));
    EXPECT_EQ(record->boot, 0U);
  };
  expect_time(0);
  LinkFrame of_no_block = stamped(capture.data(1), 0x700000);
  of_no_block.bytes[1] = 77;
  LinkFrame of_other_size = stamped(capture.data(1), 0xE00000);
  --of_other_size.size;
  feed_all(session, {of_no_block, of_no_block, of_other_size, of_other_size});
  expect_time(1);
  EXPECT_EQ(session.unreadable().unknown_block, 2U);
  EXPECT_EQ(session.unreadable().misfit, 2U);
}

TEST(LogSession, AnotherTableThatNobodyAskedForIsIgnored) {
  const SyntheticCapture capture;
  const LinkFrame other_table = received(hex("50 03 8b 01 8c a1 4c 71 10 80"));
  LogSession session;
  feed_all(session, capture.handshake());
  feed_all(session, {other_table});
  EXPECT_TRUE(session.on_frame(capture.data(0)).has_value());
  feed_all(session, {sent(hex("5c 03")), other_table});
  EXPECT_FALSE(session.on_frame(capture.data(1)).has_value());
}

TEST(LogSession, AStampThatNoOtherPacketConfirmsIsNotBelieved) {
  const SyntheticCapture capture;
  LogSession session;
  feed_all(session, capture.handshake());
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(session.on_frame(capture.data(i)).has_value());
  const LinkFrame damaged = stamped(capture.data(5), 0x300000);
  feed_all(session, {damaged, damaged, stamped(capture.data(5), 0x900000)});
  const std::optional<LogRecord> next = session.on_frame(capture.data(5));
  ASSERT_TRUE(next.has_value());
  EXPECT_EQ(next->at, device_ms(capture.first_ms + 500));
  EXPECT_EQ(session.unreadable().wrong_time, 3U);
}

/// A vehicle with two blocks, whose packets alternate on the wire, ten of each a second.
class TwoBlocks {
 public:
  TwoBlocks() { connect(); }
  void connect() {
    feed_all(session_, SyntheticCapture{}.handshake());
    feed_all(session_, {sent(hex("5d 06 02 22 03 00")), received(hex("5d 06 02 00")),
                        sent(hex("5d 03 02 0a")), received(hex("5d 03 02 00"))});
  }
  /// A packet of each block; the times in milliseconds. How many were read.
  int pair(std::int64_t device, std::int64_t host) {
    const auto counter = static_cast<std::uint32_t>(device);
    LinkFrame first = stamped(SyntheticCapture{}.data(0), counter);
    first.at = host_ms(host);
    const LinkFrame second = received(LogPacket(2, counter + 3).u16(700).bytes(), host_ms(host + 3));
    return read(first, device) + read(second, device + 3);
  }
  [[nodiscard]] std::uint32_t boot() const { return boot_; }

 private:
  int read(const LinkFrame& frame, std::int64_t device) {
    const std::optional<LogRecord> record = session_.on_frame(frame);
    if (!record) return 0;
    EXPECT_EQ(record->at, device_ms(device));
    boot_ = record->boot;
    return 1;
  }
  LogSession session_;
  std::uint32_t boot_ = 0;
};

TEST(LogSession, AClockThatHasRestartedIsBelievedFromItsSecondPacketOn) {
  TwoBlocks vehicle;
  for (std::int64_t i = 0; i < 5; ++i) EXPECT_EQ(vehicle.pair(11'000 + 100 * i, 100 * i), 2);
  EXPECT_EQ(vehicle.pair(500, 500), 1);
  int read = 0;
  for (std::int64_t i = 1; i <= 50; ++i) read += vehicle.pair(500 + 100 * i, 500 + 100 * i);
  EXPECT_EQ(read, 100);
}

TEST(LogSession, AStepOfTheHostsClockCostsNothing) {
  for (const int step : {5000, -5000}) {
    TwoBlocks vehicle;
    int read = 0;
    for (std::int64_t i = 0; i < 50; ++i) read += vehicle.pair(1000 + 100 * i, 100 * i);
    for (std::int64_t i = 50; i < 100; ++i) read += vehicle.pair(1000 + 100 * i, step + 100 * i);
    EXPECT_EQ(read, 200) << step;
  }
}

TEST(LogSession, AStepOfTheHostsClockIsNoRebootAtTheNextConnection) {
  TwoBlocks vehicle;
  for (std::int64_t i = 0; i < 50; ++i) EXPECT_EQ(vehicle.pair(1000 + 100 * i, 100 * i), 2);
  for (std::int64_t i = 50; i < 250; ++i) EXPECT_EQ(vehicle.pair(1000 + 100 * i, 30'000 + 100 * i), 2);
  vehicle.connect();
  EXPECT_EQ(vehicle.pair(27'000, 56'000), 2);
  EXPECT_EQ(vehicle.boot(), 0U);
  vehicle.connect();
  EXPECT_EQ(vehicle.pair(2000, 61'000), 2);
  EXPECT_EQ(vehicle.boot(), 1U);
}

TEST(LogSession, WhatWaitedInTheVehicleIsReadWhole) {
  TwoBlocks vehicle;
  int read = vehicle.pair(1000, 0);
  for (std::int64_t i = 1; i < 80; ++i) read += vehicle.pair(1000 + 100 * i, 8000);
  EXPECT_EQ(read, 160);
  // What did not fit into its queue was dropped there.
  for (std::int64_t i = 120; i < 130; ++i) read += vehicle.pair(1000 + 100 * i, 100 * i);
  EXPECT_EQ(read, 180);
}

TEST(LogSession, AQueueThatWasFlushedIsNoReboot) {
  TwoBlocks vehicle;
  for (std::int64_t i = 0; i < 100; ++i) EXPECT_EQ(vehicle.pair(1000 + 100 * i, 190 * i), 2);
  vehicle.connect();
  EXPECT_EQ(vehicle.pair(21'000, 20'000), 2);  // 9 s less late than the packets before
  EXPECT_EQ(vehicle.boot(), 0U);
  vehicle.connect();
  EXPECT_EQ(vehicle.pair(2000, 30'000), 2);
  EXPECT_EQ(vehicle.boot(), 1U);
}

TEST(LogSession, NoTrafficKeepsItFromLearningAgain) {
  std::mt19937 random(11);
  LogSession session;
  const std::vector<std::uint8_t> headers{0x50, 0x5C, 0x51, 0x5D, 0x52, 0x5E};
  const auto on_nonsense = [&] {
    Bytes packet(1 + random() % 31);
    for (std::uint8_t& byte : packet) byte = static_cast<std::uint8_t>(random() & 0xFF);
    packet[0] = headers[random() % headers.size()];
    if (packet.size() > 1 && random() % 2 == 0) packet[1] = static_cast<std::uint8_t>(2 + random() % 7);
    if (packet.size() > 2 && random() % 2 == 0) packet[2] = 1;
    const LinkFrame frame = random() % 2 == 0 ? sent(packet) : received(packet);
    const auto record = session.on_frame(frame);
    for (std::size_t i = 0; record && i < record->entry_count; ++i)
      EXPECT_FALSE(session.name_of(*record, i).empty());
  };
  for (int round = 0; round < 1000; ++round) {
    for (int i = 0; i < 100; ++i) on_nonsense();
    feed_all(session, SyntheticCapture{}.handshake());
    const LinkFrame data = SyntheticCapture{}.data(round % 8);
    const auto record = session.on_frame(data);
    ASSERT_TRUE(record.has_value()) << "round " << round;
    ASSERT_EQ(record->entry_count, 7U);
    ASSERT_EQ(record->value(4), 700.0);
  }
}

/// The published values of a flight beside what each packet of its capture decodes to.
class RealFlight : public testing::TestWithParam<const char*> {};

struct PublishedRow {
  double host_time_s = 0.0;
  std::int64_t device_ms = 0;
  std::vector<double> values;
};

std::map<int, std::vector<PublishedRow>> read_published(const std::string& path) {
  std::map<int, std::vector<PublishedRow>> rows;
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    if (line.starts_with('#')) continue;
    std::vector<double> numbers;
    std::stringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) numbers.push_back(std::stod(cell));
    rows[static_cast<int>(numbers[0])].push_back(
        {numbers[1], static_cast<std::int64_t>(numbers[2]), {numbers.begin() + 3, numbers.end()}});
  }
  return rows;
}

TEST_P(RealFlight, EachValueOfEachPacketIsThePublishedOne) {
  const std::string capture = reference_file("flights/" + std::string(GetParam()) + ".pcap");
  const std::string published = reference_file("flights/" + std::string(GetParam()) + ".csv");
  SWIFTLET_REQUIRE_REFERENCE(capture);
  SWIFTLET_REQUIRE_REFERENCE(published);
  auto rows = read_published(published);
  struct Column {
    const char* name;
    double scale;
    double tolerance;
  };
  const std::map<int, std::vector<Column>> columns{{1,
                                                    {{"stateEstimateZ.x", 1e-3, 1e-9},
                                                     {"stateEstimateZ.y", 1e-3, 1e-9},
                                                     {"stateEstimateZ.z", 1e-3, 1e-9},
                                                     {"stateEstimateZ.vx", 1e-3, 1e-9},
                                                     {"stateEstimateZ.vy", 1e-3, 1e-9},
                                                     {"stateEstimateZ.vz", 1e-3, 1e-9},
                                                     {"stateEstimateZ.rateRoll", 1e-3, 1e-9},
                                                     {"stateEstimateZ.ratePitch", 1e-3, 1e-9},
                                                     {"stateEstimateZ.rateYaw", 1e-3, 1e-9},
                                                     {"pm.vbatMV", 1e-3, 1e-9},
                                                     {"radio.rssi", 1.0, 1e-9}}},
                                                   {2,
                                                    {{"stateEstimate.qw", 1.0, 1e-8},
                                                     {"stateEstimate.qx", 1.0, 1e-8},
                                                     {"stateEstimate.qy", 1.0, 1e-8},
                                                     {"stateEstimate.qz", 1.0, 1e-8},
                                                     {"range.front", 1e-3, 1e-9},
                                                     {"range.back", 1e-3, 1e-9},
                                                     {"range.left", 1e-3, 1e-9},
                                                     {"range.right", 1e-3, 1e-9},
                                                     {"range.up", 1e-3, 1e-9}}}};

  Result<std::unique_ptr<ReplayLink>> link = ReplayLink::open(capture);
  ASSERT_TRUE(link.ok());
  LogSession session;
  std::map<int, std::size_t> next;
  for (;;) {
    const Result<LinkFrame> frame = (*link)->receive(Duration::zero());
    if (!frame) break;
    const std::optional<LogRecord> record = session.on_frame(*frame);
    if (!record) continue;
    const int block = record->block_id;
    ASSERT_LT(next[block], rows[block].size());
    const PublishedRow& row = rows[block][next[block]++];
    ASSERT_EQ(record->at, device_ms(row.device_ms));
    ASSERT_NEAR(to_seconds(record->received.time_since_epoch()), row.host_time_s, 2e-6);
    ASSERT_EQ(record->entry_count, columns.at(block).size());
    for (std::size_t i = 0; i < record->entry_count; ++i) {
      const Column& column = columns.at(block)[i];
      ASSERT_EQ(session.name_of(*record, i), column.name);
      ASSERT_NEAR(record->value(i) * column.scale, row.values[i], column.tolerance)
          << column.name << " at " << row.device_ms << " ms";
    }
  }
  EXPECT_EQ(next[1], rows[1].size());
  EXPECT_EQ(next[2], rows[2].size());
  EXPECT_EQ(session.unreadable().misfit + session.unreadable().unknown_block, 0U);
}

INSTANTIATE_TEST_SUITE_P(Flights, RealFlight, testing::Values("olsson", "rice"),
                         [](const auto& flight) { return std::string(flight.param); });

}  // namespace
}  // namespace swiftlet

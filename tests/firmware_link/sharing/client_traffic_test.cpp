// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sharing/client_traffic.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "firmware_link/link/link_packet.hpp"
#include "tests/firmware_link/frames.hpp"
#include "tests/support/allocation_counter.hpp"

namespace swiftlet {
namespace {

class ClientTrafficTest : public testing::Test {
 protected:
  ClientTrafficTest() { reset_log(); }
  void reset_log() {
    owner_sends(log_reset_request());
    static_cast<void>(from_vehicle({0x5D, 5, 0, 0}));
  }
  void owner_sends(const CrtpPacket& packet) {
    LinkFrame frame = frame_of(LinkDirection::kToVehicle, now_, bytes_of(packet));
    EXPECT_FALSE(traffic_.on_frame(frame));
  }
  /// What the client gets; is_ours_: the owner gets it, too.
  Bytes from_vehicle(const Bytes& packet) {
    LinkFrame frame = frame_of(LinkDirection::kFromVehicle, now_, packet);
    Bytes clients = packet_bytes(traffic_.on_frame(frame));
    is_ours_ = frame.is_ours;
    return clients;
  }
  void take(std::span<const std::uint8_t> packet) { traffic_.take(packet, now_); }
  Bytes next(bool owner_waits = false) { return packet_bytes(traffic_.next_packet(owner_waits, now_)); }

  ClientTraffic traffic_;
  HostTime now_{std::chrono::seconds(100)};
  bool is_ours_ = false;
};

TEST_F(ClientTrafficTest, WhatSteersComesFirstAndInItsOrder) {
  take(Bytes{0x2D, 1, 0});
  take(Bytes{0x3C, 1});
  take(Bytes{0x7C, 2});
  take(Bytes{0x8C, 3});
  take(Bytes{0x3C, 4});
  EXPECT_TRUE(traffic_.has_packet(now_));
  EXPECT_EQ(next(true), (Bytes{0x3C, 1}));
  EXPECT_EQ(next(true), (Bytes{0x7C, 2}));
  EXPECT_EQ(next(true), (Bytes{0x8C, 3}));
  EXPECT_EQ(next(true), (Bytes{0x3C, 4}));
  EXPECT_EQ(next(true), (Bytes{0x2D, 1, 0}));
  EXPECT_EQ(next(true), Bytes{});
  EXPECT_FALSE(traffic_.has_packet(now_));
}

TEST_F(ClientTrafficTest, SetpointsThatNewerOnesHaveOvertakenAreNotSentLate) {
  const auto after = [this](std::int64_t ms, const Bytes& packet) {
    now_ += std::chrono::milliseconds(ms);
    take(packet);
  };
  take(Bytes{0x3C, 1});
  after(10, {0x7C, 1});  // the only one of its kind
  after(10, {0x8C, 1});  // a command, no setpoint
  for (std::uint8_t i = 2; i <= 80; ++i) after(10, {0x3C, i});
  EXPECT_EQ(next(), (Bytes{0x7C, 1}));
  EXPECT_EQ(next(), (Bytes{0x8C, 1}));
  for (std::uint8_t i = 71; i <= 80; ++i) EXPECT_EQ(next(), (Bytes{0x3C, i}));
  EXPECT_EQ(next(), Bytes{});
  EXPECT_EQ(traffic_.counters().steering_dropped, 70U);
}

TEST_F(ClientTrafficTest, TheNewestSetpointIsSentHoweverLate) {
  take(Bytes{0x3C, 1});
  now_ += std::chrono::milliseconds(900);
  EXPECT_EQ(next(), (Bytes{0x3C, 1}));
}

TEST_F(ClientTrafficTest, ARequestThatComesBackIsTheNextOneAndWhatSteersIsGone) {
  for (std::uint8_t i = 1; i <= 2; ++i) take(Bytes{0x2D, i, 0});
  traffic_.take_back(packet_of(next()));
  traffic_.take_back(packet_of(Bytes{0x3C, 1}));
  EXPECT_EQ(next(), (Bytes{0x2D, 1, 0}));
  EXPECT_EQ(next(), (Bytes{0x2D, 2, 0}));
  traffic_.take_back(packet_of(Bytes{0x2D, 2, 0}));
  EXPECT_TRUE(traffic_.has_packet(now_));
  EXPECT_EQ(next(), (Bytes{0x2D, 2, 0}));
  EXPECT_FALSE(traffic_.has_packet(now_));
}

TEST_F(ClientTrafficTest, ALogBlockThatComesBackIsVoidOnceTheOwnerHasResetTheLog) {
  take(Bytes{0x5D, 6, 1, 7, 0, 0});
  traffic_.take_back(packet_of(next()));
  reset_log();
  EXPECT_EQ(next(), Bytes{});
  EXPECT_TRUE(traffic_.take_loss_of_blocks());
}

TEST_F(ClientTrafficTest, RequestsTakeTurnsWithTheOwners) {
  for (std::uint8_t i = 0; i < 3; ++i) take(Bytes{0x2D, i, 0});
  EXPECT_EQ(next(true), (Bytes{0x2D, 0, 0}));
  EXPECT_EQ(next(true), Bytes{}) << "the owner's turn";
  EXPECT_EQ(next(true), (Bytes{0x2D, 1, 0}));
  EXPECT_EQ(next(false), (Bytes{0x2D, 2, 0})) << "the owner has nothing to send";
}

TEST_F(ClientTrafficTest, MoreSetpointsThanTheLinkCarriesLetOtherPacketsThrough) {
  for (int i = 0; i < 200; ++i) take(Bytes{0x3C, 1});
  take(Bytes{0x2D, 1, 0});
  int owners = 0;
  int requests = 0;
  for (int i = 0; i < 190; ++i) {
    const Bytes packet = next(true);
    owners += packet.empty() ? 1 : 0;
    requests += packet.size() == 3 ? 1 : 0;
  }
  EXPECT_EQ(requests, 1);
  EXPECT_EQ(owners, 1);
}

TEST_F(ClientTrafficTest, RequestsWaitUntilTheOwnerHasResetTheLogSetpointsDoNot) {
  owner_sends(log_reset_request());
  take(Bytes{0x2D, 1, 0});
  EXPECT_FALSE(traffic_.has_packet(now_));
  EXPECT_EQ(next(), Bytes{});
  take(Bytes{0x3C, 1});
  EXPECT_TRUE(traffic_.has_packet(now_));
  EXPECT_EQ(next(), (Bytes{0x3C, 1}));
  EXPECT_EQ(from_vehicle({0x5D, 5, 0, 0}), Bytes{});
  EXPECT_TRUE(is_ours_);
  EXPECT_EQ(next(), (Bytes{0x2D, 1, 0}));
}

TEST_F(ClientTrafficTest, NullPacketsOfTheClientDoNotReachTheVehiclesRadio) {
  for (const Bytes& packet : {Bytes{0xFF}, Bytes{0xFF, 0x05, 0x00}, Bytes{0xFF, 0xFE, 0x01}, Bytes{}})
    take(packet);
  take(Bytes(32, 0x2D));
  EXPECT_FALSE(traffic_.has_packet(now_));
}

TEST_F(ClientTrafficTest, EachSideGetsItsOwnAnswers) {
  const Bytes item{0x50, 2, 7, 0, 7, 'a', 0, 'b', 0};
  take(bytes_of(toc_item_request(kLogTocTopic, 7)));
  EXPECT_EQ(next().size(), 4U);
  EXPECT_EQ(from_vehicle(item), item);
  EXPECT_FALSE(is_ours_);
  owner_sends(toc_item_request(kLogTocTopic, 7));
  EXPECT_EQ(from_vehicle(item), Bytes{});
  EXPECT_TRUE(is_ours_);
}

TEST_F(ClientTrafficTest, ToTheSameQuestionBothGetTheSameAnswerOnce) {
  const Bytes item{0x50, 2, 7, 0, 7, 'a', 0, 'b', 0};
  owner_sends(toc_item_request(kLogTocTopic, 7));
  take(bytes_of(toc_item_request(kLogTocTopic, 7)));
  EXPECT_EQ(next().size(), 4U);
  EXPECT_EQ(from_vehicle(item), item);
  EXPECT_TRUE(is_ours_);
  EXPECT_EQ(from_vehicle(item), Bytes{});
}

TEST_F(ClientTrafficTest, AnItemThatOnlyTheClientMissesDoesNotEndTheOwnersTable) {
  owner_sends(toc_item_request(kLogTocTopic, 7));
  take(bytes_of(toc_item_request(kLogTocTopic, 9999)));
  EXPECT_EQ(next().size(), 4U);
  EXPECT_EQ(from_vehicle({0x50, 2}), (Bytes{0x50, 2}));
  EXPECT_FALSE(is_ours_);
}

TEST_F(ClientTrafficTest, WhatTheVehicleSaysToAllGoesToBoth) {
  for (const Bytes& packet : {Bytes{0x00, 'h', 'i'}, Bytes{0x2F, 1, 3, 0, 1}}) {
    EXPECT_EQ(from_vehicle(packet), packet);
    EXPECT_TRUE(is_ours_);
  }
}

TEST_F(ClientTrafficTest, LogDataGoesToItsOwner) {
  take(Bytes{0x5D, 6, 1, 7, 0, 0});
  const std::uint8_t number = next()[2];
  EXPECT_EQ(from_vehicle({0x52, 1, 0, 0, 0, 42}), Bytes{});
  EXPECT_TRUE(is_ours_);
  EXPECT_EQ(from_vehicle({0x52, number, 0, 0, 0, 42}), (Bytes{0x52, 1, 0, 0, 0, 42}));
  EXPECT_FALSE(is_ours_);
  EXPECT_EQ(from_vehicle({0x5D, 6, 1, 0}), Bytes{});
  EXPECT_TRUE(is_ours_);
}

TEST_F(ClientTrafficTest, AResetWithoutBlocksIsAnsweredAtOnceAndSendsNothing) {
  take(Bytes{0x5D, 5});
  take(Bytes{0x2D, 1, 0});
  EXPECT_EQ(next(), Bytes{});
  EXPECT_EQ(packet_bytes(traffic_.take_answer()), (Bytes{0x5D, 5, 0, 0}));
  EXPECT_EQ(next(), (Bytes{0x2D, 1, 0}));
}

TEST_F(ClientTrafficTest, ALogThatTheOwnerResetsCostsTheClientItsBlocks) {
  EXPECT_FALSE(traffic_.take_loss_of_blocks()) << "it had none";
  take(Bytes{0x5D, 6, 1, 7, 0, 0});
  EXPECT_FALSE(next().empty());
  reset_log();
  EXPECT_TRUE(traffic_.take_loss_of_blocks());
  EXPECT_FALSE(traffic_.take_loss_of_blocks()) << "once";
  take(Bytes{0x5D, 6, 1, 7, 0, 0});
  EXPECT_FALSE(next().empty());
  traffic_.abandon();
  reset_log();
  EXPECT_FALSE(traffic_.take_loss_of_blocks()) << "nobody wants them any more";
}

TEST_F(ClientTrafficTest, ASecondAnswerToARepeatedResetCostsNoBlocks) {
  owner_sends(log_reset_request());
  owner_sends(log_reset_request());
  EXPECT_EQ(from_vehicle({0x5D, 5, 0, 0}), Bytes{});
  take(Bytes{0x5D, 6, 1, 7, 0, 0});
  const std::uint8_t number = next()[2];
  EXPECT_EQ(from_vehicle({0x5D, 5, 0, 0}), Bytes{});
  EXPECT_TRUE(is_ours_);
  EXPECT_FALSE(traffic_.take_loss_of_blocks());
  EXPECT_EQ(from_vehicle({0x5D, 6, number, 0}), (Bytes{0x5D, 6, 1, 0}));
}

TEST_F(ClientTrafficTest, AClientThatIsGoneLeavesItsLastSetpointsAndDeletionsOnly) {
  take(Bytes{0x5D, 6, 1, 7, 0, 0});
  const std::uint8_t number = next()[2];
  take(Bytes{0x3C, 1});
  take(Bytes{0x2D, 1, 0});
  traffic_.take_back(packet_of(Bytes{0x2D, 2, 0}));
  traffic_.abandon();
  EXPECT_EQ(next(), (Bytes{0x3C, 1}));
  EXPECT_EQ(next(), (Bytes{0x5D, 2, number}));
  EXPECT_EQ(next(), Bytes{});
}

TEST_F(ClientTrafficTest, WhatFindsNoRoomIsCounted) {
  for (int i = 0; i < 70; ++i) take(Bytes{0x2D, 1, 0});
  for (int i = 0; i < 300; ++i) take(Bytes{0x3C, 1});
  EXPECT_EQ(traffic_.counters().requests_dropped, 6U);
  EXPECT_EQ(traffic_.counters().steering_dropped, 44U);
  traffic_.drop_steering();
  EXPECT_EQ(traffic_.counters().steering_dropped, 300U);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/emulated_receiver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "firmware_link/crtp/crtp_packet.hpp"

namespace swiftlet {
namespace {

using Bytes = std::vector<std::uint8_t>;
using std::chrono::milliseconds;
using testing::ElementsAre;

class EmulatedReceiverTest : public testing::Test {
 protected:
  EmulatedReceiverTest()
      : vehicle_(make_simulated_world("loop").value(), radio_vehicle(), 1), receiver_(vehicle_, /*seed=*/1) {}

  AirExchange send(const Bytes& packet, int retransmissions = 0) {
    return receiver_.exchange(AirSetting{}, packet, retransmissions);
  }
  /// The ACK payload; fails the test without an ACK.
  Bytes ack_of(const Bytes& packet) {
    const AirExchange exchange = send(packet);
    EXPECT_TRUE(exchange.acked);
    return {exchange.payload.begin(), exchange.payload.end()};
  }
  void lose_acks(const Bytes& packet) {
    receiver_.losses.ack = 1.0;
    EXPECT_FALSE(send(packet).acked);
    receiver_.losses.ack = 0.0;
  }

  /// One variable every 10 ms.
  void start_logging() {
    ack_of({0x5D, 0x06, 0x01, 0x07, 0x00, 0x00});
    ack_of({0x5D, 0x03, 0x01, 0x01});
    ack_of({0xFF});
    ack_of({0xFF});
  }
  static VehicleModel radio_vehicle() {
    VehicleModel model;
    model.link_timeout = kRadioLinkTimeout;
    return model;
  }

  SimulatedVehicle vehicle_;
  EmulatedReceiver receiver_;
};

TEST_F(EmulatedReceiverTest, AnswersOnlyItsOwnChannelRateAndAddress) {
  const Bytes poll{0xFF};
  EXPECT_TRUE(send(poll).acked);
  AirSetting other;
  other.channel = 81;
  EXPECT_FALSE(receiver_.exchange(other, poll, 3).acked);
  other = {};
  other.rate = RadioRate::k1Mbps;
  EXPECT_FALSE(receiver_.exchange(other, poll, 3).acked);
  other = {};
  other.address[4] = 0x01;
  EXPECT_FALSE(receiver_.exchange(other, poll, 3).acked);
}

TEST_F(EmulatedReceiverTest, AnAnswerComesWithALaterPacketNeverWithTheRequestsOwn) {
  EXPECT_THAT(ack_of({0xDD, 0x00}), ElementsAre(0xF3));
  EXPECT_THAT(ack_of({0xFF}), ElementsAre(0xDD, 0x00, 0x0C, 0x00, 0x00, 0x00));
}

TEST_F(EmulatedReceiverTest, IdleAcksToggleTheirBitWithoutSafelink) {
  EXPECT_THAT(ack_of({0xFF}), ElementsAre(0xF3));
  EXPECT_THAT(ack_of({0xFF}), ElementsAre(0xF7));
  EXPECT_THAT(ack_of({0xFF}), ElementsAre(0xF3));
}

TEST_F(EmulatedReceiverTest, ALostAckWithoutSafelinkDoublesTheRequestAndLosesTheAnswer) {
  ack_of({0xFC, 0x01});
  lose_acks({0xFC, 0x02});  // would have carried the answer to 01
  EXPECT_THAT(ack_of({0xFC, 0x02}), ElementsAre(0xFC, 0x02));
  EXPECT_THAT(ack_of({0xFF}), ElementsAre(0xFC, 0x02));
  EXPECT_EQ(receiver_.uplink().size(), 3U);
}

TEST_F(EmulatedReceiverTest, EachRetransmissionIsANewPacketWithoutSafelink) {
  receiver_.losses = {.packet = 0.0, .ack = 1.0, .retries_share_fate = true};
  EXPECT_FALSE(send({0xFC, 0x01}, /*retransmissions=*/3).acked);
  EXPECT_EQ(receiver_.uplink().size(), 4U);
}

TEST_F(EmulatedReceiverTest, EchoesASafelinkRequestInItsOwnAck) {
  EXPECT_THAT(ack_of({0xFF, 0x05, 0x01}), ElementsAre(0xFF, 0x05, 0x01));
  EXPECT_TRUE(receiver_.safelink());
  EXPECT_THAT(ack_of({0xFF, 0x05, 0x01}), ElementsAre(0xFF, 0x05, 0x01));
  EXPECT_THAT(ack_of({0xFF, 0x05, 0x00}), ElementsAre(0xFF, 0x05, 0x00));
  EXPECT_FALSE(receiver_.safelink());
}

TEST_F(EmulatedReceiverTest, OldFirmwareEchoesOnlyTheFirstOfTwoSafelinkRequests) {
  receiver_.old_firmware = true;
  EXPECT_THAT(ack_of({0xFF, 0x05, 0x01}), ElementsAre(0xFF, 0x05, 0x01));
  EXPECT_THAT(ack_of({0xFF, 0x05, 0x01}), ElementsAre(0xF7));
  EXPECT_THAT(ack_of({0xFF, 0x05, 0x01}), ElementsAre(0xFF, 0x05, 0x01));
}

// The counters as the host keeps them: up and down begin at 0.
TEST_F(EmulatedReceiverTest, SafelinkTakesARepeatedPacketOnceAndRepeatsItsAnswer) {
  ack_of({0xFF, 0x05, 0x01});
  EXPECT_THAT(ack_of({0xF0, 0x01}), ElementsAre(0xF3));  // up 0, down 0
  lose_acks({0xFC, 0x02});                               // up 1, down 1: its ACK held the answer to 01
  EXPECT_THAT(ack_of({0xFC, 0x02}), ElementsAre(0xF4, 0x01));
  EXPECT_THAT(ack_of({0xF3}), ElementsAre(0xF8 & 0xF3, 0x02));
  EXPECT_EQ(receiver_.uplink().size(), 2U);
}

TEST_F(EmulatedReceiverTest, TellsTheRetransmissionsThatWereNeeded) {
  receiver_.losses.packet = 0.5;
  int most = 0;
  for (int i = 0; i < 200; ++i) {
    const AirExchange exchange = send({0xFF}, /*retransmissions=*/3);
    if (exchange.acked) most = std::max(most, exchange.retries);
    EXPECT_LE(exchange.retries, 3);
  }
  EXPECT_EQ(most, 3);
}

TEST_F(EmulatedReceiverTest, KeepsTwoHundredAndEightPacketsAndDropsTheRest) {
  start_logging();
  for (int i = 0; i < 4; ++i) {
    receiver_.advance(milliseconds(900));
    ack_of({0xFF});
  }
  EXPECT_GT(receiver_.dropped(), 100U);
  EXPECT_NEAR(static_cast<double>(receiver_.queued_log().size()), 208.0, 8.0);
}

TEST_F(EmulatedReceiverTest, IsSilentWhileTheVehicleBootsAndHasForgottenSafelink) {
  ack_of({0xFF, 0x05, 0x01});
  ack_of({0xF0, 0x01});
  vehicle_.reboot();
  receiver_.advance(milliseconds(1000));
  EXPECT_FALSE(send({0xFF}, 3).acked);
  receiver_.advance(milliseconds(4000));
  EXPECT_TRUE(send({0xFF}, 3).acked);
  EXPECT_FALSE(receiver_.safelink());
}

TEST_F(EmulatedReceiverTest, ThrowsAwayWhatTheVehicleQueuedBeforeASecondOfSilence) {
  start_logging();
  receiver_.advance(milliseconds(999));
  const std::size_t queued = receiver_.queued_log().size();
  receiver_.advance(milliseconds(500));
  EXPECT_EQ(receiver_.queued_log().size(), EmulatedReceiver::kRadioQueue);
  EXPECT_GE(receiver_.dropped(), queued - EmulatedReceiver::kRadioQueue);
}

}  // namespace
}  // namespace swiftlet

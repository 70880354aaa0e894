// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/safelink.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/firmware_link/fake_dongle.hpp"

namespace swiftlet {
namespace {

TEST(Safelink, KeepsTheHeadersBitsUntilThePacketIsAcknowledged) {
  Safelink safelink;
  EXPECT_EQ(safelink.header(0xFF), 0xF3);
  EXPECT_EQ(safelink.header(0x5D), 0x51);
  EXPECT_EQ(safelink.acknowledged(Bytes{0xF3}), Safelink::Payload::kNew);
  EXPECT_EQ(safelink.header(0xF3), 0xFF);
  EXPECT_EQ(safelink.header(0xF3), 0xFF);
  EXPECT_EQ(safelink.acknowledged(Bytes{0xF3}), Safelink::Payload::kRepeat);
  EXPECT_EQ(safelink.header(0xF3), 0xF7) << "an acknowledgement with a repeat is one all the same";
  EXPECT_EQ(safelink.acknowledged({}), Safelink::Payload::kNone);
  EXPECT_EQ(safelink.header(0xF3), 0xFF);
  EXPECT_EQ(safelink.acknowledged(Bytes{0x56, 1}), Safelink::Payload::kNew);
  safelink.restart();
  EXPECT_EQ(safelink.header(0xFF), 0xF3);
}

TEST(Safelink, AcceptsOnlyTheEchoAsConfirmation) {
  EXPECT_TRUE(is_safelink_echo(safelink_request(true), true));
  EXPECT_TRUE(is_safelink_echo(Bytes{0xF3, 5, 1}, true)) << "newer radios overwrite the link bits";
  EXPECT_FALSE(is_safelink_echo(Bytes{0xFF, 5, 0}, true));
  EXPECT_FALSE(is_safelink_echo(Bytes{0xFF, 5}, true));
  EXPECT_FALSE(is_safelink_echo(Bytes{0xF3}, true));
  EXPECT_FALSE(is_safelink_echo(Bytes{0x5F, 5, 1}, true));
  EXPECT_TRUE(is_safelink_echo(safelink_request(false), false));
  EXPECT_FALSE(is_safelink_echo(safelink_request(true), false));
}

/// Sends numbered packets both ways; fate 0: delivered, 1: packet lost, 2: acknowledgement lost.
void expect_each_packet_once(unsigned fates, int count) {
  Safelink host;
  FakeRadioVehicle vehicle;
  static_cast<void>(vehicle.on_frame({0xFF, 5, 1}));
  Bytes sent;
  Bytes received;
  for (std::uint8_t i = 0; i < 5; ++i) vehicle.waiting.push_back({0x50, i});
  for (int i = 0; sent.size() < 12; ++i, fates /= 3) {
    const unsigned fate = i < count ? fates % 3 : 0;
    if (fate == 1) continue;
    const Bytes payload = vehicle.on_frame({host.header(0x5D), static_cast<std::uint8_t>(sent.size())});
    if (fate == 2) continue;
    sent.push_back(static_cast<std::uint8_t>(sent.size()));
    if (host.acknowledged(payload) == Safelink::Payload::kNew && payload.size() > 1)
      received.push_back(payload[1]);
  }
  Bytes accepted;
  for (const Bytes& packet : vehicle.accepted) accepted.push_back(packet[1]);
  ASSERT_EQ(accepted, sent);
  ASSERT_EQ(received, (Bytes{0, 1, 2, 3, 4}));
}

TEST(Safelink, LosesAndDuplicatesNothingWhateverIsLost) {
  constexpr int kCount = 8;
  for (unsigned fates = 0; fates < 6561; ++fates) {  // 3 to the 8th: each way in which eight packets can fare
    SCOPED_TRACE(fates);
    expect_each_packet_once(fates, kCount);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace swiftlet

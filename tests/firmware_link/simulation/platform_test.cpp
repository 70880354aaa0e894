// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/platform.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace swiftlet {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes bytes_in(const std::optional<PacketBytes>& packet) {
  return packet ? Bytes(packet->begin(), packet->end()) : Bytes{};
}
Bytes link(const Bytes& packet) { return bytes_in(answer_link_service(packet)); }
Bytes platform(const Bytes& packet) { return bytes_in(answer_platform_service(packet)); }
Bytes supervisor(const Bytes& packet, bool is_flying = false) {
  return bytes_in(answer_supervisor_service(packet, is_flying));
}

TEST(LinkService, EchoesEveryByte) {
  EXPECT_EQ(link({0xFC, 0x01, 0x02}), (Bytes{0xFC, 0x01, 0x02}));
  EXPECT_EQ(link(Bytes(31, 0xFC)), Bytes(31, 0xFC));
}

TEST(LinkService, ReturnsItsNameInAFullPacket) {
  const Bytes source = link({0xFD, 0x00});
  ASSERT_EQ(source.size(), 31U);
  EXPECT_EQ(std::string(source.begin() + 1, source.begin() + 20), std::string("Bitcraze Crazyflie") + '\0');
}

TEST(LinkService, DoesNotAnswerSinkAndNullPackets) {
  EXPECT_TRUE(link({0xFE, 0x01}).empty());
  EXPECT_TRUE(link({0xFF}).empty());
}

TEST(PlatformService, ReturnsVersionFirmwareAndType) {
  EXPECT_EQ(platform({0xDD, 0x00}), (Bytes{0xDD, 0x00, 12, 0, 0, 0}));
  const Bytes firmware = platform({0xDD, 0x01});
  EXPECT_EQ(std::string(firmware.begin() + 2, firmware.end()), "swiftlet simulation");
  const Bytes type = platform({0xDD, 0x02});
  EXPECT_EQ(std::string(type.begin() + 2, type.end()), "Crazyflie 2.1");
}

TEST(PlatformService, AnswersCommandsInTheirOwnBuffer) {
  EXPECT_EQ(platform({0xDC, 0x00, 0x01}), (Bytes{0xDC, 0x00, 0x01})) << "continuous wave";
  EXPECT_EQ(platform({0xDC, 0x01, 0x01}), (Bytes{0xDC, 0x01, 0x01})) << "armed";
  EXPECT_EQ(platform({0xDC, 0x01, 0x00}), (Bytes{0xDC, 0x01, 0x00})) << "not disarmed";
  EXPECT_EQ(platform({0xDC, 0x02}), (Bytes{0xDC, 0x02, 0x01})) << "recovered";
  EXPECT_EQ(platform({0xDC, 0x03, 0x01}), (Bytes{0xDC})) << "user notified";
}

TEST(PlatformService, DoesNotAnswerTheAppChannelAndUnknownPackets) {
  EXPECT_TRUE(platform({0xDC}).empty());
  EXPECT_TRUE(platform({0xDE, 0x01}).empty());
  EXPECT_TRUE(platform({0xDD, 0x07}).empty());
}

TEST(SupervisorService, ReturnsAllStatesAsBits) {
  EXPECT_EQ(supervisor({0x9C, 0x0C}), (Bytes{0x90, 0x8C, 0x0F, 0x00}));
  EXPECT_EQ(supervisor({0x9C, 0x0C}, true), (Bytes{0x90, 0x8C, 0x1F, 0x00}));
}

TEST(SupervisorService, ReturnsEachState) {
  EXPECT_EQ(supervisor({0x9C, 0x05}), (Bytes{0x90, 0x85, 0})) << "flying";
  EXPECT_EQ(supervisor({0x9C, 0x05}, true), (Bytes{0x90, 0x85, 1}));
  EXPECT_EQ(supervisor({0x9C, 0x0B}), (Bytes{0x90, 0x8B, 0})) << "high-level control disabled";
  EXPECT_TRUE(supervisor({0x9C, 0x0D}).empty());
  EXPECT_TRUE(supervisor({0x9C, 0x00}).empty());
}

TEST(SupervisorService, ConfirmsArmingAndRecoveryButNotTheEmergencyStop) {
  EXPECT_EQ(supervisor({0x9D, 0x01, 0x01}), (Bytes{0x91, 0x81, 1, 1}));
  EXPECT_EQ(supervisor({0x9D, 0x01, 0x00}), (Bytes{0x91, 0x81, 0, 1})) << "it arms itself";
  EXPECT_EQ(supervisor({0x9D, 0x02}), (Bytes{0x91, 0x82, 1, 1}));
  EXPECT_TRUE(supervisor({0x9D, 0x03}).empty());
  EXPECT_TRUE(supervisor({0x9D, 0x04}).empty());
}

}  // namespace
}  // namespace swiftlet

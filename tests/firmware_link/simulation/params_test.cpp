// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/params.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace swiftlet {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kNoEntry = 2;
constexpr std::uint8_t kAccess = 13;
constexpr std::uint8_t kInvalid = 22;

class ParamService : public testing::Test {
 protected:
  Bytes ask(const Bytes& packet) {
    const auto reply = params_.handle(packet);
    return reply ? Bytes(reply->begin(), reply->end()) : Bytes{};
  }
  /// A request with the parameter's id behind the first bytes, and what follows.
  Bytes ask(Bytes head, std::uint16_t id, const Bytes& rest = {}) {
    head.push_back(static_cast<std::uint8_t>(id));
    head.push_back(static_cast<std::uint8_t>(id >> 8U));
    head.insert(head.end(), rest.begin(), rest.end());
    return ask(head);
  }
  /// What a reply holds behind its head of `bytes`.
  static Bytes behind(std::size_t bytes, const Bytes& reply) {
    return reply.size() < bytes ? Bytes{}
                                : Bytes(reply.begin() + static_cast<std::ptrdiff_t>(bytes), reply.end());
  }
  Bytes set_by_name(const std::string& group, const std::string& name, const Bytes& type_and_value) {
    Bytes packet{0x2F, 0x00};
    packet.insert(packet.end(), group.begin(), group.end());
    packet.push_back(0);
    packet.insert(packet.end(), name.begin(), name.end());
    packet.push_back(0);
    const std::size_t head = packet.size();
    packet.insert(packet.end(), type_and_value.begin(), type_and_value.end());
    const Bytes reply = ask(packet);
    EXPECT_TRUE(
        std::equal(packet.begin(), packet.begin() + static_cast<std::ptrdiff_t>(head), reply.begin()));
    return behind(head, reply);
  }

  const std::uint16_t filter_mask_ = simulated_param_id("multiranger", "filterMask");  // uint16, default 1
  const std::uint16_t roll_kp_ = simulated_param_id("pid_attitude", "roll_kp");        // float, persistent, 6
  const std::uint16_t deck_ = simulated_param_id("deck", "bcFlow2");                   // uint8, read-only
  const std::uint16_t absent_ = 0x7FFF;
  SimulatedParams params_;
};

TEST_F(ParamService, ReturnsSizeAndKeyOfItsTable) {
  const Bytes info = ask({0x2C, 0x03});
  ASSERT_EQ(info.size(), 8U);
  EXPECT_EQ(info[0], 0x20) << "link bits 0";
  EXPECT_EQ(info[2] | info[3] << 8U, simulated_param_table().size());
  EXPECT_EQ(info[4], simulated_param_table_crc() & 0xFFU);
}

TEST_F(ParamService, ReturnsAnItemWithItsFlags) {
  const Bytes reply = ask({0x2C, 0x02}, simulated_param_id("deck", "bcMultiranger"));
  EXPECT_EQ(reply[0], 0x20);
  EXPECT_EQ(reply[4], 0x68);
  EXPECT_EQ(std::string(reply.begin() + 5, reply.end()), std::string("deck\0bcMultiranger\0", 19));
}

TEST_F(ParamService, AnswersWithTwoBytesBeyondItsTableAndNotTo8BitCommands) {
  EXPECT_EQ(ask({0x2C, 0x02}, absent_), (Bytes{0x20, 0x02}));
  EXPECT_TRUE(ask({0x2C, 0x00, 0x00}).empty());
  EXPECT_TRUE(ask({0x2C, 0x01}).empty());
}

TEST_F(ParamService, ReadsValuesBehindAStatus) {
  EXPECT_EQ(behind(3, ask({0x2D}, filter_mask_)), (Bytes{0, 1, 0}));
  EXPECT_EQ(behind(3, ask({0x2D}, roll_kp_)), (Bytes{0, 0x00, 0x00, 0xC0, 0x40}));
  EXPECT_EQ(behind(3, ask({0x2D}, absent_)), Bytes{kNoEntry});
}

TEST_F(ParamService, EchoesWritesAndKeepsThem) {
  const Bytes written = ask({0x2E}, filter_mask_, {0x11, 0x02});
  EXPECT_EQ(written[0], 0x2E);
  EXPECT_EQ(behind(3, written), (Bytes{0x11, 0x02}));
  EXPECT_EQ(params_.number(filter_mask_), 0x211);
  EXPECT_EQ(behind(3, ask({0x2D}, filter_mask_)), (Bytes{0, 0x11, 0x02}));
}

TEST_F(ParamService, RefusesWritesAsTheFirmwareDoes) {
  EXPECT_EQ(behind(3, ask({0x2E}, absent_, {1})), Bytes{kNoEntry});
  EXPECT_TRUE(ask({0x2E}, deck_, {1}).empty()) << "read-only: silence";
  EXPECT_EQ(params_.number(deck_), 0.0);
}

TEST_F(ParamService, SetsByName) {
  EXPECT_EQ(set_by_name("multiranger", "filterMask", {0x09, 3, 0}), Bytes{0});
  EXPECT_EQ(params_.number(filter_mask_), 3.0);
  EXPECT_EQ(set_by_name("multiranger", "nothing", {0x09, 3, 0}), Bytes{kNoEntry});
  EXPECT_EQ(set_by_name("multiranger", "filterMask", {0x08, 3}), Bytes{kInvalid});
  EXPECT_EQ(set_by_name("deck", "bcFlow2", {0x08, 1}), Bytes{kAccess});
  EXPECT_TRUE(ask({0x2F, 0x00, 'a', 'b', 0, 'c'}).empty()) << "a name without end";
}

TEST_F(ParamService, DoesNotAnswerNamesThatFillThePacket) {
  Bytes packet(31, 'x');
  packet[0] = 0x2F;
  packet[1] = packet[10] = packet[30] = 0;
  EXPECT_TRUE(ask(packet).empty());
}

TEST_F(ParamService, ReturnsExtendedTypes) {
  EXPECT_EQ(behind(4, ask({0x2F, 0x07}, roll_kp_)), (Bytes{0, 1}));
  EXPECT_EQ(behind(4, ask({0x2F, 0x07}, filter_mask_)), Bytes{kNoEntry});
  EXPECT_EQ(behind(4, ask({0x2F, 0x02}, roll_kp_)), Bytes{1});
  EXPECT_EQ(behind(4, ask({0x2F, 0x02}, absent_)), Bytes{kNoEntry});
}

TEST_F(ParamService, ReturnsDefaultsAfterWrites) {
  ask({0x2E}, filter_mask_, {7, 0});
  EXPECT_EQ(behind(4, ask({0x2F, 0x08}, filter_mask_)), (Bytes{0, 1, 0}));
  EXPECT_EQ(behind(4, ask({0x2F, 0x06}, filter_mask_)), (Bytes{1, 0}));
  EXPECT_EQ(behind(4, ask({0x2F, 0x08}, deck_)), Bytes{kNoEntry}) << "read-only ones have none";
  EXPECT_EQ(behind(4, ask({0x2F, 0x06}, absent_)), Bytes{kNoEntry});
}

TEST_F(ParamService, KeepsStoredValuesAcrossABootAndResetsTheRest) {
  const Bytes one{0x00, 0x00, 0x80, 0x3F};
  const Bytes six{0x00, 0x00, 0xC0, 0x40};
  ask({0x2E}, roll_kp_, one);
  ask({0x2E}, filter_mask_, {7, 0});
  EXPECT_EQ(behind(4, ask({0x2F, 0x03}, roll_kp_)), Bytes{0});
  params_.boot();
  EXPECT_EQ(params_.number(roll_kp_), 1.0);
  EXPECT_EQ(params_.number(filter_mask_), 1.0);

  Bytes state{1};
  state.insert(state.end(), six.begin(), six.end());
  state.insert(state.end(), one.begin(), one.end());
  EXPECT_EQ(behind(4, ask({0x2F, 0x04}, roll_kp_)), state);
  EXPECT_EQ(behind(4, ask({0x2F, 0x05}, roll_kp_)), Bytes{0});
  EXPECT_EQ(behind(4, ask({0x2F, 0x05}, roll_kp_)), Bytes{kNoEntry});
  state.resize(5);
  state[0] = 0;
  EXPECT_EQ(behind(4, ask({0x2F, 0x04}, roll_kp_)), state);
  EXPECT_EQ(behind(4, ask({0x2F, 0x04}, absent_)), Bytes{kNoEntry});
}

TEST_F(ParamService, NotifiesTheHostOfChangesByTheVehicle) {
  const PacketBytes notice = params_.change(filter_mask_, 258.0);
  EXPECT_EQ(Bytes(notice.begin(), notice.end()),
            (Bytes{0x23, 0x01, static_cast<std::uint8_t>(filter_mask_),
                   static_cast<std::uint8_t>(filter_mask_ >> 8U), 2, 1}));
}

TEST_F(ParamService, KeepsNumbersInTheirTypes) {
  const std::uint16_t passed = simulated_param_id("system", "selftestPassed");  // int8
  params_.set(passed, -1.0);
  EXPECT_EQ(params_.number(passed), -1.0);
  EXPECT_EQ(behind(3, ask({0x2D}, passed)), (Bytes{0, 0xFF}));
  params_.set(roll_kp_, 0.1);
  EXPECT_EQ(params_.number(roll_kp_), static_cast<double>(0.1F));
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sharing/client_log_blocks.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

class ClientLogBlocksTest : public testing::Test {
 protected:
  ClientLogBlocks::Outcome ask(const Bytes& request) { return blocks_.on_request(request); }
  /// The vehicle's number of a block that the client makes.
  std::uint8_t make(std::uint8_t block) {
    const Bytes sent = packet_bytes(ask({0x5D, 6, block, 7, 0, 0}).request);
    EXPECT_EQ(sent.size(), 6U);
    const std::uint8_t number = sent.empty() ? std::uint8_t{0} : sent[2];
    EXPECT_EQ(packet_bytes(blocks_.on_answer(Bytes{0x5D, 6, number, 0})), (Bytes{0x5D, 6, block, 0}));
    return number;
  }

  ClientLogBlocks blocks_;
  HostTime now_{std::chrono::seconds(100)};
};

TEST_F(ClientLogBlocksTest, NumbersAreTranslatedBothWays) {
  const std::uint8_t number = make(1);
  EXPECT_TRUE(ClientLogBlocks::has_number(number));
  EXPECT_FALSE(ClientLogBlocks::has_number(kMaxOwnLogBlocks));
  EXPECT_EQ(packet_bytes(ask({0x5D, 3, 1, 10}).request), (Bytes{0x5D, 3, number, 10}));
  EXPECT_EQ(packet_bytes(blocks_.on_answer(Bytes{0x5D, 3, number, 0})), (Bytes{0x5D, 3, 1, 0}));
  EXPECT_EQ(packet_bytes(blocks_.on_data(Bytes{0x52, number, 1, 2, 3, 42})), (Bytes{0x52, 1, 1, 2, 3, 42}));
  EXPECT_FALSE(blocks_.on_data(Bytes{0x52, static_cast<std::uint8_t>(number + 1), 1, 2, 3, 42}));
}

TEST_F(ClientLogBlocksTest, TheOwnersBlocksAreOutOfReach) {
  for (const std::uint8_t command : {std::uint8_t{2}, std::uint8_t{3}, std::uint8_t{7}, std::uint8_t{8}}) {
    const ClientLogBlocks::Outcome outcome = ask({0x5D, command, 1, 10, 0, 0});
    EXPECT_FALSE(outcome.request);
    EXPECT_EQ(packet_bytes(outcome.answer), (Bytes{0x5D, command, 1, 2})) << "no such block";
  }
  EXPECT_EQ(packet_bytes(ask({0x5D, 0, 1, 7, 0}).answer), (Bytes{0x5D, 0, 1, 8})) << "of the first version";
  EXPECT_FALSE(ask({0x5D}).request);
  EXPECT_FALSE(ask({0x5D, 2}).request);
}

TEST_F(ClientLogBlocksTest, TheOwnersRoomIsKept) {
  for (std::uint8_t block = 0; block < 13; ++block) static_cast<void>(make(block));
  EXPECT_EQ(packet_bytes(ask({0x5D, 6, 99, 7, 0, 0}).answer), (Bytes{0x5D, 6, 99, 12}));
  const std::uint8_t number = packet_bytes(ask({0x5D, 2, 5}).request)[2];
  static_cast<void>(blocks_.on_answer(Bytes{0x5D, 2, number, 0}));
  EXPECT_EQ(ClientLogBlocks::kMaxBlocks + kMaxOwnLogBlocks, 16U);
  EXPECT_NE(make(99), 0);
}

TEST_F(ClientLogBlocksTest, VariablesAreCounted) {
  std::size_t variables = 0;
  Bytes nine{0x5D, 6, 0};
  for (int i = 0; i < 9; ++i) nine.insert(nine.end(), {1, 0, 0});
  while (ask(nine).request) {
    variables += 9;
    ++nine[2];
  }
  EXPECT_EQ(variables, 99U);
  EXPECT_EQ(packet_bytes(ask({0x5D, 7, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}).answer),
            (Bytes{0x5D, 7, 0, 12}));
  EXPECT_TRUE(ask({0x5D, 7, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}).request);
}

TEST_F(ClientLogBlocksTest, ABlockCountsNoMoreVariablesThanItHoldsHoweverOftenItIsRefusedMore) {
  const std::uint8_t number = make(0);
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(ask({0x5D, 7, 0, 7, 0, 0, 7, 0, 0, 7, 0, 0}).request) << i;
    static_cast<void>(blocks_.on_answer(Bytes{0x5D, 7, number, 7}));
  }
  Bytes nine{0x5D, 6, 1};
  for (int i = 0; i < 9; ++i) nine.insert(nine.end(), {1, 0, 0});
  while (ask(nine).request) ++nine[2];
  EXPECT_EQ(nine[2] - 1, 8) << "of the 77 variables that are left";
}

TEST_F(ClientLogBlocksTest, AResetDeletesWhatIsThereAndIsAnsweredThen) {
  const std::vector<std::uint8_t> numbers{make(1), make(2)};
  EXPECT_FALSE(blocks_.is_resetting());
  EXPECT_FALSE(ask({0x5D, 5}).request);
  EXPECT_TRUE(blocks_.is_resetting());
  EXPECT_EQ(packet_bytes(blocks_.next_deletion(now_)), (Bytes{0x5D, 2, numbers[0]}));
  EXPECT_EQ(packet_bytes(blocks_.next_deletion(now_)), (Bytes{0x5D, 2, numbers[1]}));
  EXPECT_FALSE(blocks_.next_deletion(now_));
  EXPECT_FALSE(blocks_.on_answer(Bytes{0x5D, 2, numbers[0], 0})) << "the client has not asked for that";
  EXPECT_FALSE(blocks_.take_reset_answer());
  now_ += std::chrono::milliseconds(201);
  EXPECT_EQ(packet_bytes(blocks_.next_deletion(now_)), (Bytes{0x5D, 2, numbers[1]})) << "lost: again";
  EXPECT_FALSE(blocks_.on_answer(Bytes{0x5D, 2, numbers[1], 2}));
  EXPECT_EQ(packet_bytes(blocks_.take_reset_answer()), (Bytes{0x5D, 5, 0, 0}));
  EXPECT_FALSE(blocks_.take_reset_answer());
  EXPECT_FALSE(blocks_.is_resetting());
}

TEST_F(ClientLogBlocksTest, ALateAnswerAboutABlockThatIsGoneDoesNotMeetItsSuccessor) {
  const std::uint8_t first = make(1);
  static_cast<void>(ask({0x5D, 2, 1}));
  static_cast<void>(blocks_.on_answer(Bytes{0x5D, 2, first, 0}));
  const std::uint8_t second = make(1);
  EXPECT_NE(first, second);
  EXPECT_FALSE(blocks_.on_answer(Bytes{0x5D, 2, first, 2}));
  EXPECT_TRUE(blocks_.on_data(Bytes{0x52, second, 0, 0, 0}));
}

TEST_F(ClientLogBlocksTest, ALeftBlockIsDeletedAndItsDataIsNobodys) {
  const std::uint8_t number = make(1);
  blocks_.abandon();
  EXPECT_FALSE(blocks_.on_data(Bytes{0x52, number, 0, 0, 0}));
  EXPECT_TRUE(blocks_.deletion_is_due(now_));
  EXPECT_EQ(packet_bytes(blocks_.next_deletion(now_)), (Bytes{0x5D, 2, number}));
  EXPECT_NE(make(1), number) << "the next client's block of that number is another one";
  EXPECT_FALSE(blocks_.take_reset_answer());
}

TEST_F(ClientLogBlocksTest, AResetByTheOwnerEndsThemAll) {
  static_cast<void>(make(1));
  static_cast<void>(ask({0x5D, 5}));
  EXPECT_FALSE(blocks_.forget_all()) << "it has asked for that itself";
  EXPECT_EQ(packet_bytes(blocks_.take_reset_answer()), (Bytes{0x5D, 5, 0, 0}));
  EXPECT_EQ(packet_bytes(ask({0x5D, 3, 1, 10}).answer), (Bytes{0x5D, 3, 1, 2}));
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/log_block_table.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

class LogBlockTableTest : public testing::Test {
 protected:
  void exchange(const char* request, const char* reply) {
    table_.on_request(hex(request));
    table_.on_reply(hex(reply));
  }
  LogBlockTable table_;
};

TEST_F(LogBlockTableTest, LearnsABlockFromCreateAppendAndStart) {
  exchange("5d 06 01 77 3e 00 22 3f 00", "5d 06 01 00");
  exchange("5d 07 01 28 40 01", "5d 07 01 00");
  exchange("5d 03 01 0a", "5d 03 01 00");
  const LogBlock& block = table_[1];
  EXPECT_TRUE(block.exists);
  EXPECT_TRUE(block.running);
  EXPECT_EQ(block.period, milliseconds(100));
  ASSERT_EQ(block.entries.size(), 3U);
  EXPECT_EQ(block.entries[0].type, LogType::kFloat);
  EXPECT_EQ(block.entries[1].offset, 4);
  EXPECT_EQ(block.entries[2].type, LogType::kHalf);
  EXPECT_EQ(block.entries[2].variable, 0x140);
  EXPECT_EQ(block.entries[2].offset, 6);
  EXPECT_EQ(table_.entries_in(1, 8), 3U);
  EXPECT_EQ(table_.entries_in(1, 7), 0U);
}

TEST_F(LogBlockTableTest, ReadsThePeriodOfTheSecondStartCommandInMilliseconds) {
  exchange("5d 06 01 77 3e 00", "5d 06 01 00");
  exchange("5d 08 01 2c 01", "5d 08 01 00");
  EXPECT_EQ(table_[1].period, milliseconds(300));
}

TEST_F(LogBlockTableTest, StopKeepsTheLayoutDeleteAndResetDiscardIt) {
  exchange("5d 06 01 77 3e 00", "5d 06 01 00");
  exchange("5d 06 02 77 3e 00", "5d 06 02 00");
  exchange("5d 06 03 77 3e 00", "5d 06 03 00");
  exchange("5d 03 01 0a", "5d 03 01 00");
  exchange("5d 04 01", "5d 04 01 00");
  EXPECT_TRUE(table_[1].exists);
  EXPECT_FALSE(table_[1].running);
  exchange("5d 02 01", "5d 02 01 00");
  EXPECT_FALSE(table_[1].exists);
  EXPECT_TRUE(table_[2].exists);
  exchange("5d 05", "5d 05 f8 00");
  EXPECT_FALSE(table_[2].exists);
  EXPECT_FALSE(table_[3].exists);
}

TEST_F(LogBlockTableTest, AReplyToAResetThatNobodyRequestedDiscardsNothing) {
  exchange("5d 05", "5d 05 f8 00");
  exchange("5d 06 01 77 3e 00", "5d 06 01 00");
  table_.on_reply(hex("5d 05 f8 00"));
  EXPECT_TRUE(table_[1].exists);
}

TEST_F(LogBlockTableTest, DropsABlockThatTheVehicleDoesNotKnow) {
  exchange("5d 06 01 77 3e 00", "5d 06 01 00");
  exchange("5d 03 01 0a", "5d 03 01 02");
  EXPECT_FALSE(table_[1].exists);
}

TEST_F(LogBlockTableTest, AnExistingBlockKeepsItsContents) {
  exchange("5d 06 01 77 3e 00", "5d 06 01 00");
  exchange("5d 06 01 22 3f 00", "5d 06 01 11");
  ASSERT_EQ(table_[1].entries.size(), 1U);
  EXPECT_EQ(table_[1].entries[0].variable, 0x3E);
}

TEST_F(LogBlockTableTest, AnExistingBlockOfUnknownOriginIsTheRequestedOne) {
  exchange("5d 06 01 77 3e 00", "5d 06 01 11");
  EXPECT_EQ(table_.entries_in(1, 4), 1U);
}

TEST_F(LogBlockTableTest, ARefusedCreateLeavesTheEntriesBeforeTheFailingOne) {
  exchange("5d 06 01 77 3e 00 22 3f 00 77 ff 7f", "5d 06 01 02");
  EXPECT_EQ(table_.entries_in(1, 6), 2U);
  EXPECT_EQ(table_.entries_in(1, 4), 1U);
  EXPECT_EQ(table_.entries_in(1, 5), 0U);
}

TEST_F(LogBlockTableTest, ARefusedAppendLeavesTheEntriesBeforeTheFailingOne) {
  exchange("5d 06 01 77 3e 00", "5d 06 01 00");
  exchange("5d 07 01 22 3f 00 77 ff 7f", "5d 07 01 02");
  EXPECT_EQ(table_.entries_in(1, 4), 1U);
  EXPECT_EQ(table_.entries_in(1, 6), 2U);
}

TEST_F(LogBlockTableTest, AnUnknownCommandChangesNothing) {
  exchange("5d 06 01 77 3e 00", "5d 06 01 00");
  exchange("5d 07 01 22 3f 00", "5d 07 01 08");
  EXPECT_EQ(table_.entries_in(1, 4), 1U);
  EXPECT_EQ(table_.entries_in(1, 6), 0U);
}

TEST_F(LogBlockTableTest, AfterARepeatedAppendReplyTheSizeDecidesHowOftenItRan) {
  exchange("5d 06 01 77 3e 00", "5d 06 01 00");
  exchange("5d 07 01 22 3f 00", "5d 07 01 00");
  table_.on_reply(hex("5d 07 01 00"));
  EXPECT_EQ(table_.entries_in(1, 6), 2U);
  EXPECT_EQ(table_.entries_in(1, 8), 3U);
}

TEST_F(LogBlockTableTest, ARequestWithoutAReplyIsAcceptedWhenTheSizeConfirmsIt) {
  table_.on_request(hex("5d 06 01 77 3e 00"));
  EXPECT_FALSE(table_[1].exists);
  EXPECT_EQ(table_.entries_in(1, 6), 0U);
  EXPECT_EQ(table_.entries_in(1, 4), 1U);
  table_.on_request(hex("5d 07 01 22 3f 00"));
  EXPECT_EQ(table_.entries_in(1, 6), 2U);
}

TEST_F(LogBlockTableTest, ALateReplyToADeleteLeavesTheCreateThatFollowedIt) {
  exchange("5d 02 01", "5d 02 01 00");
  table_.on_request(hex("5d 06 01 77 3e 00"));
  table_.on_reply(hex("5d 02 01 02"));  // to a repetition of the delete
  table_.on_reply(hex("5d 06 01 00"));
  EXPECT_EQ(table_.entries_in(1, 4), 1U);
}

TEST_F(LogBlockTableTest, NeverHoldsMoreThanAPacketCarries) {
  exchange("5d 06 01 77 01 00 77 02 00 77 03 00 77 04 00 77 05 00 77 06 00 77 07 00 77 08 00", "5d 06 01 07");
  EXPECT_EQ(table_[1].entries.size(), 6U);
  EXPECT_EQ(table_.entries_in(1, 24), 6U);
}

TEST_F(LogBlockTableTest, RevisionChangesWithEveryChange) {
  const std::uint32_t before = table_.revision();
  exchange("5d 06 01 77 3e 00", "5d 06 01 00");
  EXPECT_NE(table_.revision(), before);
}

}  // namespace
}  // namespace swiftlet

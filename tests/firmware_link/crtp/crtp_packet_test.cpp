// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/crtp/crtp_packet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAreArray;

TEST(CrtpPacket, RequestsAreByteExact) {
  EXPECT_THAT(source_request(), ElementsAreArray(hex("fd 00")));
  EXPECT_THAT(version_request(VersionQuery::kProtocol), ElementsAreArray(hex("dd 00")));
  EXPECT_THAT(toc_info_request(kLogTocTopic), ElementsAreArray(hex("5c 03")));
  EXPECT_THAT(toc_item_request(kLogTocTopic, 0x018B), ElementsAreArray(hex("5c 02 8b 01")));
  EXPECT_THAT(log_reset_request(), ElementsAreArray(hex("5d 05")));
  EXPECT_THAT(log_start_request(1, 10), ElementsAreArray(hex("5d 03 01 0a")));
}

TEST(CrtpPacket, CreateRequestHoldsNineEntriesAndNoMore) {
  CrtpPacket request = log_block_request(LogCommand::kCreate, 1);
  for (const std::uint16_t id : std::vector<std::uint16_t>{0x3E, 0x3F, 0x40, 0x49})
    EXPECT_TRUE(add_log_entry(request, 7, id));
  EXPECT_THAT(request, ElementsAreArray(hex("5d 06 01 07 3e 00 07 3f 00 07 40 00 07 49 00")));
  for (int i = 4; i < 9; ++i) EXPECT_TRUE(add_log_entry(request, 7, 1));
  EXPECT_FALSE(add_log_entry(request, 7, 1));
  EXPECT_EQ(request.size(), 30U);
}

TEST(CrtpPacket, TopicIsReadWithoutTheLinkBits) {
  for (const std::uint8_t header : Bytes{0x52, 0x56, 0x5A, 0x5E}) {
    const Bytes packet{header, 1};
    EXPECT_TRUE(is_on(packet, kLogDataTopic));
    EXPECT_FALSE(is_on(packet, kLogControlTopic));
  }
  EXPECT_FALSE(is_on(Bytes{}, kLogDataTopic));
}

}  // namespace
}  // namespace swiftlet

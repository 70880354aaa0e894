// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/crtp/toc_item.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

TEST(TocItem, ReadsTheRepliesOfTheWireDocument) {
  const auto info = read_toc_info(hex("50 03 8b 01 8c a1 4c 71 10 80"));
  ASSERT_TRUE(info.has_value());
  EXPECT_EQ(*info, (TocInfo{395, 0x714CA18C}));
  const auto item = read_toc_item(hex("50 02 09 00 02 72 61 6e 67 65 00 66 72 6f 6e 74 00"));
  ASSERT_TRUE(item.has_value());
  EXPECT_EQ(*item, (TocItem{9, 2, "range.front"}));
}

TEST(TocItem, RefusesATruncatedOrOtherReply) {
  EXPECT_FALSE(read_toc_info(hex("50 03 8b 01 8c")).has_value());
  EXPECT_FALSE(read_toc_info(hex("50 02 8b 01 8c a1 4c 71")).has_value());
  EXPECT_FALSE(read_toc_item(hex("50 02")).has_value());
  EXPECT_FALSE(read_toc_item(hex("50 02 09 00 02 72 61")).has_value());
}

TEST(TocItem, AReplyReadsAsItsItem) {
  const TocItem item{300, 7, "stateEstimate.x"};
  const auto reply = toc_item_reply(kLogTocTopic, item);
  ASSERT_TRUE(reply.has_value());
  EXPECT_TRUE(is_on(bytes_of(*reply), kLogTocTopic));
  EXPECT_EQ(read_toc_item(bytes_of(*reply)), item);
  EXPECT_FALSE(toc_item_reply(kLogTocTopic, {1, 7, "agroupnamethatislong.andanametoo"}).has_value());
  EXPECT_FALSE(toc_item_reply(kLogTocTopic, {1, 7, "nogroup"}).has_value());
}

}  // namespace
}  // namespace swiftlet

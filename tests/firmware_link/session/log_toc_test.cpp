// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/log_toc.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

TEST(LogToc, LearnsFromRepliesAsMeasured) {
  LogToc toc;
  EXPECT_TRUE(toc.on_reply(hex("50 03 8b 01 8c a1 4c 71 10 80")));
  ASSERT_TRUE(toc.info().has_value());
  EXPECT_EQ(toc.info()->count, 395);
  EXPECT_EQ(toc.info()->crc, 0x714CA18CU);
  EXPECT_TRUE(toc.on_reply(hex("50 02 09 00 02 72 61 6e 67 65 00 66 72 6f 6e 74 00")));
  EXPECT_EQ(toc.name_of(9), "range.front");
  EXPECT_EQ(toc.type_of(9), LogType::kUint16);
}

TEST(LogToc, HasNoNameForAnUnknownItem) {
  LogToc toc;
  EXPECT_FALSE(toc.on_reply(hex("50 02")));
  EXPECT_FALSE(toc.on_reply(hex("50 02 09 00 0f 72 00 66 00")));
  EXPECT_FALSE(toc.on_reply(hex("50 02 09 00 02 72 72")));
  EXPECT_FALSE(toc.on_reply(hex("50 03 8b 01")));
  EXPECT_EQ(toc.name_of(9), "");
  EXPECT_FALSE(toc.has(9));
}

TEST(LogToc, ClearsAllWhenTheChecksumChanges) {
  LogToc toc;
  toc.on_reply(hex("50 03 8b 01 8c a1 4c 71 10 80"));
  toc.on_reply(toc_item_reply(3, LogType::kFloat, "stateEstimate", "x"));
  toc.on_reply(hex("50 03 8b 01 8c a1 4c 71 10 80"));
  EXPECT_TRUE(toc.has(3));
  toc.on_reply(hex("50 03 8b 01 8c a1 4c 72 10 80"));
  EXPECT_FALSE(toc.has(3));
}

}  // namespace
}  // namespace swiftlet

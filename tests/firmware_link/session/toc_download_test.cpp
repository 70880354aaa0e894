// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/toc_download.hpp"

#include <gmock/gmock.h>

#include <vector>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;

class TocDownloadTest : public testing::Test {
 protected:
  /// The request that is due, as bytes; empty where there is none.
  Bytes request(std::int64_t ms) {
    const std::optional<CrtpPacket> due = download_.next_request(host_ms(ms));
    return due ? Bytes(due->begin(), due->end()) : Bytes{};
  }

  TocCache cache_;
  TocDownload download_{kLogTocTopic, cache_};
  const Bytes info_ = hex("50 03 0200 8CA14C71 10 80");
  const Bytes front_ = toc_item_reply(0, LogType::kUint16, "range", "front");
  const Bytes x_ = toc_item_reply(1, LogType::kFloat, "stateEstimate", "x");
};

TEST_F(TocDownloadTest, DownloadsAllItemsAndStoresTheTableInTheCache) {
  EXPECT_EQ(request(0), hex("5c 03"));
  download_.on_frame(info_, host_ms(1));
  EXPECT_EQ(request(1), hex("5c 02 0000"));
  EXPECT_EQ(request(2), hex("5c 02 0100"));
  download_.on_frame(x_, host_ms(3));
  EXPECT_FALSE(download_.finished());
  EXPECT_EQ(download_.progress(), 0.5);
  download_.on_frame(front_, host_ms(4));
  EXPECT_TRUE(download_.finished());
  EXPECT_FALSE(download_.came_from_cache());
  EXPECT_EQ(request(1000), Bytes{});
  ASSERT_NE(download_.find("stateEstimate.x"), nullptr);
  EXPECT_EQ(download_.find("stateEstimate.x")->id, 1);
  EXPECT_EQ(download_.find("stateEstimate.y"), nullptr);
  EXPECT_EQ(cache_.load(kLogTocTopic.port, TocInfo{2, 0x714CA18C}), download_.items());
}

TEST_F(TocDownloadTest, RequestsNoMoreItemsAtATimeThanTheFirmwareQueues) {
  EXPECT_EQ(request(0), hex("5c 03"));
  download_.on_frame(hex("50 03 6400 8CA14C71 10 80"), host_ms(1));
  std::size_t requests = 0;
  while (!request(2).empty()) ++requests;
  EXPECT_EQ(requests, TocDownload::kMaxOpen);
  download_.on_frame(front_, host_ms(3));
  EXPECT_EQ(request(3), hex("5c 02 1000"));
  EXPECT_EQ(request(3), Bytes{});
}

TEST_F(TocDownloadTest, TakesAKnownTableFromTheCache) {
  const std::vector<TocItem> items{{0, 2, "range.front"}, {1, 7, "stateEstimate.x"}};
  cache_.store(kLogTocTopic.port, TocInfo{2, 0x714CA18C}, items);
  download_.on_frame(info_, host_ms(0));
  EXPECT_TRUE(download_.finished());
  EXPECT_TRUE(download_.came_from_cache());
  EXPECT_EQ(download_.items(), items);
  EXPECT_EQ(request(1000), Bytes{});
}

TEST_F(TocDownloadTest, RepeatsARequestUntilItsOwnAnswerComes) {
  EXPECT_EQ(request(0), hex("5c 03"));
  EXPECT_EQ(request(199), Bytes{});
  EXPECT_EQ(request(200), hex("5c 03"));
  download_.on_frame(info_, host_ms(201));
  download_.on_frame(info_, host_ms(201));  // of the repetition
  EXPECT_EQ(request(202), hex("5c 02 0000"));
  EXPECT_EQ(request(203), hex("5c 02 0100"));
  download_.on_frame(front_, host_ms(204));  // a round trip of 2 ms
  download_.on_frame(front_, host_ms(204));  // of a repetition
  EXPECT_EQ(request(222), Bytes{});
  EXPECT_EQ(request(223), hex("5c 02 0100"));
  EXPECT_EQ(request(262), Bytes{}) << "twice as long";
  EXPECT_EQ(request(263), hex("5c 02 0100"));
}

TEST_F(TocDownloadTest, WaitsAsLongAsAnswersTake) {
  EXPECT_EQ(request(0), hex("5c 03"));
  download_.on_frame(info_, host_ms(150));
  EXPECT_EQ(request(150), hex("5c 02 0000"));
  EXPECT_EQ(request(150), hex("5c 02 0100"));
  EXPECT_EQ(request(150 + 449), Bytes{}) << "150 ms and four times their half";
  EXPECT_EQ(request(150 + 450), hex("5c 02 0000"));
}

TEST_F(TocDownloadTest, ReadsItsOwnPortOnly) {
  Bytes of_params = info_;
  of_params[0] = 0x20;
  download_.on_frame(of_params, host_ms(0));
  EXPECT_EQ(request(0), hex("5c 03"));
}

TEST_F(TocDownloadTest, FailsIfTheTableEndsBeforeItsCount) {
  download_.on_frame(info_, host_ms(0));
  EXPECT_EQ(request(0), hex("5c 02 0000"));
  download_.on_frame(front_, host_ms(1));
  for (int i = 0; i < 4; ++i) download_.on_frame(hex("50 02"), host_ms(2 + i));
  ASSERT_TRUE(download_.failure().has_value());
  EXPECT_THAT(download_.failure()->message, HasSubstr("item 1 of 2"));
  EXPECT_FALSE(download_.finished());
  EXPECT_EQ(request(1000), Bytes{});
  EXPECT_FALSE(cache_.load(kLogTocTopic.port, TocInfo{2, 0x714CA18C}).has_value());
}

TEST_F(TocDownloadTest, ADamagedRequestForAnItemDoesNotEndTheTable) {
  download_.on_frame(info_, host_ms(0));
  EXPECT_EQ(request(0), hex("5c 02 0000"));
  for (int i = 0; i < 3; ++i) download_.on_frame(hex("50 02"), host_ms(1));
  download_.on_frame(front_, host_ms(2));
  for (int i = 0; i < 3; ++i) download_.on_frame(hex("50 02"), host_ms(3));
  EXPECT_FALSE(download_.failure().has_value());
  EXPECT_DOUBLE_EQ(download_.progress(), 0.5);
}

TEST_F(TocDownloadTest, AnEmptyTableIsComplete) {
  download_.on_frame(hex("50 03 0000 00000000 10 80"), host_ms(0));
  EXPECT_TRUE(download_.finished());
  EXPECT_TRUE(download_.items().empty());
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sharing/open_requests.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

TEST(OpenRequestsTest, AnAnswerIsItsOwnersWhateverTheLinkBits) {
  OpenRequests open;
  open.sent(bytes_of(toc_item_request(kLogTocTopic, 0x0109)));
  EXPECT_FALSE(open.take_answer(Bytes{0x50, 0x02, 0x0A, 0x01, 7, 'a', 0, 'b', 0}));
  EXPECT_FALSE(open.take_answer(Bytes{0x20, 0x02, 0x09, 0x01, 7, 'a', 0, 'b', 0}));
  EXPECT_TRUE(open.take_answer(Bytes{0x54, 0x02, 0x09, 0x01, 7, 'a', 0, 'b', 0}));
  EXPECT_FALSE(open.take_answer(Bytes{0x54, 0x02, 0x09, 0x01, 7, 'a', 0, 'b', 0}));
}

TEST(OpenRequestsTest, EachKindIsMatchedByWhatItsAnswerRepeats) {
  OpenRequests open;
  for (const CrtpPacket& request :
       {source_request(), version_request(VersionQuery::kFirmware), toc_info_request(kParamTocTopic),
        param_read_request(0x30), make_crtp_packet(kLinkEchoTopic, {1, 2, 3})})
    open.sent(bytes_of(request));
  EXPECT_FALSE(open.take_answer(Bytes{0xFC, 1, 2}));
  EXPECT_FALSE(open.take_answer(Bytes{0xDD, 0, 12}));
  EXPECT_FALSE(open.take_answer(Bytes{0x2D, 0x31, 0, 0, 1}));
  EXPECT_TRUE(open.take_answer(Bytes{0xFC, 1, 2, 3}));
  EXPECT_TRUE(open.take_answer(Bytes{0xDD, 1, '2', '0'}));
  EXPECT_TRUE(open.take_answer(Bytes{0x2D, 0x30, 0, 0, 1}));
  EXPECT_TRUE(open.take_answer(Bytes{0x20, 3, 9, 0, 1, 2, 3, 4}));
  EXPECT_TRUE(open.take_answer(Bytes{0xFD, 'B', 'i'}));
}

TEST(OpenRequestsTest, AnItemThatDoesNotExistIsAnsweredWithoutItsNumber) {
  OpenRequests open;
  EXPECT_FALSE(open.take_answer(Bytes{0x50, 0x02}));
  open.sent(bytes_of(toc_item_request(kLogTocTopic, 9999)));
  EXPECT_TRUE(is_missing_item(Bytes{0x50, 0x02}));
  EXPECT_FALSE(is_missing_item(Bytes{0xF0, 0x02})) << "an echo";
  EXPECT_TRUE(open.take_answer(Bytes{0x50, 0x02}));
}

TEST(OpenRequestsTest, TheOldestAreForgottenAndOthersAreNotKept) {
  OpenRequests open;
  open.sent(bytes_of(source_request()));
  for (std::uint16_t id = 0; id < 40; ++id) open.sent(bytes_of(param_read_request(id)));
  EXPECT_FALSE(open.take_answer(Bytes{0xFD, 'B'}));
  EXPECT_TRUE(open.take_answer(Bytes{0x2D, 39, 0, 0, 1}));
  EXPECT_FALSE(answers_a_request(Bytes{0x00, 'h'}));
  EXPECT_FALSE(answers_a_request(Bytes{0x52, 1, 0, 0, 0}));
  EXPECT_FALSE(answers_a_request(Bytes{}));
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/request_queue.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

Bytes next(RequestQueue& queue) {
  const CrtpPacket packet = queue.pop();
  return {packet.begin(), packet.end()};
}

TEST(RequestQueue, ReturnsRequestsInTheirOrder) {
  RequestQueue queue;
  ASSERT_TRUE(queue.push(hex("5c 03")).ok());
  ASSERT_TRUE(queue.push(hex("5c 02 00 00")).ok());
  EXPECT_EQ(next(queue), hex("5c 03"));
  EXPECT_EQ(next(queue), hex("5c 02 00 00"));
  EXPECT_TRUE(queue.empty());
}

TEST(RequestQueue, QueuesARequestThatWaitsAlreadyOnce) {
  RequestQueue queue;
  ASSERT_TRUE(queue.push(hex("5c 03")).ok());
  ASSERT_TRUE(queue.push(hex("50 03")).ok());  // other link bits
  EXPECT_EQ(next(queue), hex("5c 03"));
  EXPECT_TRUE(queue.empty());
}

TEST(RequestQueue, DropsTheNewestWhenItIsFull) {
  RequestQueue queue;
  for (std::uint8_t i = 0; i <= RequestQueue::kCapacity; ++i) ASSERT_TRUE(queue.push(Bytes{0x5C, i}).ok());
  for (std::uint8_t i = 0; i < RequestQueue::kCapacity; ++i) EXPECT_EQ(next(queue), (Bytes{0x5C, i}));
  EXPECT_TRUE(queue.empty());
}

TEST(RequestQueue, RefusesAnInvalidRequest) {
  RequestQueue queue;
  for (const Bytes& packet : {Bytes{}, Bytes(32, 0x5C), hex("f3"), hex("ff fe 01")}) {
    const Status pushed = queue.push(packet);
    ASSERT_FALSE(pushed.ok());
    EXPECT_EQ(pushed.error().code, ErrorCode::kInvalidInput);
  }
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace swiftlet

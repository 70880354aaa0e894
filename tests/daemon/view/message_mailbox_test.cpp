// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/message_mailbox.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace swiftlet {
namespace {

std::vector<std::uint8_t> message_of(std::size_t size, std::uint8_t content) {
  return std::vector<std::uint8_t>(size, content);
}

TEST(MessageMailbox, MessagesComeOutAsTheyWentIn) {
  MessageMailbox mailbox(1000);
  MessageMailbox::Message message;
  EXPECT_FALSE(mailbox.take(message));
  mailbox.put(3, message_of(5, 7));
  mailbox.put(4, {});
  ASSERT_TRUE(mailbox.take(message));
  EXPECT_EQ(message.channel, 3U);
  EXPECT_EQ(message.bytes, message_of(5, 7));
  ASSERT_TRUE(mailbox.take(message));
  EXPECT_EQ(message.channel, 4U);
  EXPECT_TRUE(message.bytes.empty());
  EXPECT_FALSE(mailbox.take(message));
}

TEST(MessageMailbox, WhatHasNoRoomIsDroppedAndCountedAndLaterOnesPass) {
  MessageMailbox mailbox(100);
  mailbox.put(1, message_of(80, 1));
  mailbox.put(2, message_of(80, 2));
  EXPECT_EQ(mailbox.dropped(), 1U);
  MessageMailbox::Message message;
  ASSERT_TRUE(mailbox.take(message));
  EXPECT_EQ(message.channel, 1U);
  mailbox.put(3, message_of(80, 3));
  ASSERT_TRUE(mailbox.take(message));
  EXPECT_EQ(message.bytes, message_of(80, 3));
  EXPECT_EQ(mailbox.dropped(), 1U);
}

TEST(MessageMailbox, FromThreadToThreadEveryMessageThatWasNotDroppedIsWhole) {
  constexpr std::uint32_t kMessages = 20'000;
  MessageMailbox mailbox(1000);
  std::jthread writer([&mailbox] {
    for (std::uint32_t i = 0; i < kMessages; ++i)
      mailbox.put(i, message_of(i % 97, static_cast<std::uint8_t>(i)));
    bool is_taken = false;  // the last one
    while (!is_taken) {
      const std::uint64_t dropped = mailbox.dropped();
      mailbox.put(kMessages, {});
      is_taken = mailbox.dropped() == dropped;
    }
  });
  MessageMailbox::Message message;
  std::uint32_t next = 0;
  while (message.channel != kMessages) {
    if (!mailbox.take(message)) continue;
    ASSERT_GE(message.channel, next) << "in order";
    next = message.channel;
    if (next < kMessages) {
      ASSERT_EQ(message.bytes, message_of(next % 97, static_cast<std::uint8_t>(next)));
    }
  }
}

}  // namespace
}  // namespace swiftlet

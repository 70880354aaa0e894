// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/commands/tcpq_conversation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string number(std::uint32_t value) {
  std::string text;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) text.push_back(static_cast<char>(value >> shift));
  return text;
}
std::string counted(const std::string& text) {
  return number(static_cast<std::uint32_t>(text.size())) + text;
}
std::string published(const std::string& channel, const std::string& message) {
  return number(1) + counted(channel) + counted(message);
}
const std::string kGreeting = number(0x287617FB) + number(0x0100);

/// A conversation, and what it has heard.
struct Talk {
  bool receive(const std::string& text) {
    return conversation.receive({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  std::vector<std::string> heard;
  TcpqConversation conversation{[this](std::string_view channel, std::span<const std::uint8_t> message) {
    heard.push_back(std::string(channel) + ": " + std::string(message.begin(), message.end()));
  }};
};

TEST(TcpqConversation, AnswersTheGreetingAndHearsWhatIsPublished) {
  Talk talk;
  EXPECT_TRUE(talk.receive(kGreeting));
  EXPECT_THAT(talk.conversation.take_answer(), ElementsAre(0x28, 0x76, 0x17, 0xFA, 0, 0, 1, 0));
  EXPECT_TRUE(talk.receive(published("OTHER", "so") + published("COMMAND", "yes")));
  EXPECT_THAT(talk.heard, ElementsAre("OTHER: so", "COMMAND: yes"));
  EXPECT_THAT(talk.conversation.take_answer(), IsEmpty());
}

TEST(TcpqConversation, BytesMayComeOneByOne) {
  Talk talk;
  for (const char byte : kGreeting + published("COMMAND", "a") + published("COMMAND", ""))
    ASSERT_TRUE(talk.receive(std::string(1, byte)));
  EXPECT_THAT(talk.heard, ElementsAre("COMMAND: a", "COMMAND: "));
}

TEST(TcpqConversation, WhoSubscribesGetsNothing) {
  Talk talk;
  EXPECT_TRUE(talk.receive(kGreeting));
  static_cast<void>(talk.conversation.take_answer());
  EXPECT_TRUE(
      talk.receive(number(2) + counted(".*") + number(3) + counted(".*") + published("COMMAND", "a")));
  EXPECT_THAT(talk.conversation.take_answer(), IsEmpty());
  EXPECT_THAT(talk.heard, ElementsAre("COMMAND: a"));
}

TEST(TcpqConversation, WhatIsNotLcmsEndsIt) {
  Talk browser;
  EXPECT_FALSE(browser.receive("GET / HTTP/1.1\r\n"));
  EXPECT_THAT(browser.conversation.take_answer(), IsEmpty());
  Talk other;
  EXPECT_TRUE(other.receive(kGreeting));
  EXPECT_FALSE(other.receive(number(7)));
  EXPECT_THAT(other.heard, IsEmpty());
}

TEST(TcpqConversation, NothingLongIsWaitedFor) {
  Talk talk;
  EXPECT_TRUE(talk.receive(kGreeting));
  EXPECT_FALSE(talk.receive(number(1) + counted("COMMAND") + number(TcpqConversation::kMaxMessageBytes + 1)));
  Talk channel;
  EXPECT_TRUE(channel.receive(kGreeting));
  EXPECT_FALSE(channel.receive(number(1) + number(0xFFFFFFFF)));
}

}  // namespace
}  // namespace swiftlet

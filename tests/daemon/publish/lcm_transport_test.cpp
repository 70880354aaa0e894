// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/lcm_transport.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(LcmTransport, BringsWhatWasPublishedToWhoeverListensOnTheChannel) {
  const auto lcm = LcmTransport::open("memq://");
  ASSERT_TRUE(lcm.ok());
  std::vector<std::uint8_t> received;
  (*lcm)->listen("HERE", [&received](auto bytes) { received.assign(bytes.begin(), bytes.end()); });
  const std::vector<std::uint8_t> message{1, 2, 3};
  EXPECT_TRUE((*lcm)->publish("THERE", std::vector<std::uint8_t>{9}));
  EXPECT_TRUE((*lcm)->publish("HERE", message));
  for (int i = 0; i < 100 && received.empty(); ++i) (*lcm)->receive(milliseconds(100));
  EXPECT_THAT(received, ElementsAre(1, 2, 3));
}

TEST(LcmTransport, ComesBackWhenNothingIsToBeHeard) {
  const auto lcm = LcmTransport::open("memq://");
  ASSERT_TRUE(lcm.ok());
  EXPECT_FALSE((*lcm)->receive(milliseconds(10)));
  EXPECT_FALSE((*lcm)->has_ended());
}

TEST(LcmTransport, KnowsTheEndOfALogThatItReads) {
  const std::string log = testing::TempDir() + "swiftlet_lcm_transport_test.lcm";
  ASSERT_TRUE(
      (*LcmTransport::open("file://" + log + "?mode=w"))->publish("HERE", std::vector<std::uint8_t>{7}));
  const auto lcm = LcmTransport::open("file://" + log + "?mode=r&speed=0");
  ASSERT_TRUE(lcm.ok());
  std::vector<std::uint8_t> received;
  (*lcm)->listen("HERE", [&received](auto bytes) { received.assign(bytes.begin(), bytes.end()); });
  for (int i = 0; i < 100 && received.empty(); ++i) (*lcm)->receive(milliseconds(100));
  EXPECT_THAT(received, ElementsAre(7));
  for (int i = 0; i < 100 && !(*lcm)->has_ended(); ++i) EXPECT_FALSE((*lcm)->receive(milliseconds(100)));
  EXPECT_TRUE((*lcm)->has_ended());
  std::filesystem::remove(log);
}

TEST(LcmTransport, SaysNothingOfAnAbsentServerHoweverMuchIsPublished) {
  testing::internal::CaptureStderr();
  const auto lcm = LcmTransport::open("tcpq://127.0.0.1:1");
  ASSERT_TRUE(lcm.ok());
  (*lcm)->listen("HERE", [](auto /*bytes*/) {});
  for (int i = 0; i < 100; ++i) EXPECT_FALSE((*lcm)->publish("HERE", std::vector<std::uint8_t>{1}));
  EXPECT_EQ(errno, ENOTCONN);
  EXPECT_FALSE((*lcm)->receive(milliseconds(1)));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(LcmTransport, RefusesAUrlThatLcmDoesNotKnow) {
  const auto lcm = LcmTransport::open("mqtt://here");
  ASSERT_FALSE(lcm.ok());
  EXPECT_THAT(lcm.error().message, HasSubstr("\"mqtt://here\": must begin with udpm://"));
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/round_trip.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

TEST(RoundTrip, TimesTheEchoOfItsOwnPacketOnceASecond) {
  RoundTrip round_trip;
  const auto ping = round_trip.next_request(host_ms(1000));
  ASSERT_TRUE(ping.has_value());
  EXPECT_TRUE(is_on(bytes_of(*ping), kLinkEchoTopic));
  EXPECT_FALSE(round_trip.next_request(host_ms(1999)).has_value());
  round_trip.on_frame(hex("fc 01 02"), host_ms(1003));
  EXPECT_EQ(round_trip.last(), Duration(0));
  round_trip.on_frame(bytes_of(*ping), host_ms(1007));
  EXPECT_EQ(round_trip.last(), std::chrono::milliseconds(7));
  round_trip.on_frame(bytes_of(*ping), host_ms(1500));  // doubled by the radio
  EXPECT_EQ(round_trip.last(), std::chrono::milliseconds(7));
}

TEST(RoundTrip, IgnoresAnEchoThatComesAfterTheNextPing) {
  RoundTrip round_trip;
  const auto first = round_trip.next_request(host_ms(0));
  const auto second = round_trip.next_request(host_ms(1000));
  round_trip.on_frame(bytes_of(*first), host_ms(1001));
  EXPECT_EQ(round_trip.last(), Duration(0));
  round_trip.on_frame(bytes_of(*second), host_ms(1004));
  EXPECT_EQ(round_trip.last(), std::chrono::milliseconds(4));
}

}  // namespace
}  // namespace swiftlet

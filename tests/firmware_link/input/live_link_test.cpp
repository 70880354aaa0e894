// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/live_link.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <utility>

#include "tests/firmware_link/frames.hpp"
#include "tests/firmware_link/udp_peer.hpp"

namespace swiftlet {
namespace {

TEST(LiveLink, ByUdpHearsTheVehicleInTheTimeOfItsClock) {
  UdpPeer peer;
  Result<LiveLink> opened =
      open_live_link(parse_input_uri("udp://127.0.0.1:" + std::to_string(peer.port())).value());
  ASSERT_TRUE(opened.ok());
  const LiveLink live = std::move(opened).value();
  EXPECT_EQ(live.usb_bus, nullptr);
  EXPECT_FALSE(live.link->receive(Duration::zero()).ok());  // greets
  ASSERT_TRUE(peer.on_frame(1000).has_value());
  const HostTime before = live.clock->now();
  peer.say(hex("52 01 00 00 00"));
  const Result<LinkFrame> frame = live.link->receive(std::chrono::seconds(1));
  ASSERT_TRUE(frame.ok());
  EXPECT_GE(frame->at, before);
  EXPECT_LE(frame->at, live.clock->now());
}

}  // namespace
}  // namespace swiftlet

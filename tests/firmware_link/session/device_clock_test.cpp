// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/session/device_clock.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_link/frames.hpp"

namespace swiftlet {
namespace {

TEST(DeviceClockUnwrapper, ContinuesWhenTheCounterWraps) {
  DeviceClockUnwrapper clock;
  EXPECT_EQ(clock.unwrap(0xFFFFF0), device_ms(0xFFFFF0));
  EXPECT_EQ(clock.unwrap(0x000054), device_ms(0x1000054));
  EXPECT_EQ(clock.unwrap(0x0000B8), device_ms(0x10000B8));
}

TEST(DeviceClockUnwrapper, TakesAnOvertakenPacketAsEarlierAlsoAcrossTheWrap) {
  DeviceClockUnwrapper clock;
  static_cast<void>(clock.unwrap(0xFFFFF8));
  EXPECT_EQ(clock.unwrap(0x000002), device_ms(0x1000002));
  EXPECT_EQ(clock.unwrap(0xFFFFFC), device_ms(0xFFFFFC));
  EXPECT_EQ(clock.unwrap(0x000066), device_ms(0x1000066));
}

TEST(DeviceClockUnwrapper, TakesAStepOfLessThanHalfTheSpanAsForward) {
  DeviceClockUnwrapper forward;
  static_cast<void>(forward.unwrap(0));
  EXPECT_EQ(forward.unwrap(0x7FFFFF), device_ms(0x7FFFFF));
  DeviceClockUnwrapper backward;
  static_cast<void>(backward.unwrap(0));
  EXPECT_EQ(backward.unwrap(0x800000), device_ms(-0x800000));
}

TEST(DeviceClockUnwrapper, KeepsCountOverManyWraps) {
  DeviceClockUnwrapper clock;
  DeviceTime last{};
  for (std::uint32_t i = 0; i < 40; ++i) last = clock.unwrap((i * 5'000'000U) & 0xFFFFFF);
  EXPECT_EQ(last, device_ms(39LL * 5'000'000));
}

}  // namespace
}  // namespace swiftlet

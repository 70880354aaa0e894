// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/reopen_schedule.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_link/fake_dongle.hpp"

namespace swiftlet {
namespace {

TEST(ReopenSchedule, TriesAtOnceThenOnceASecond) {
  ManualLinkClock clock;
  FakeDongle bus(clock);
  ReopenSchedule schedule;
  EXPECT_TRUE(schedule.is_due(bus, host_ms(0)));
  EXPECT_FALSE(schedule.is_due(bus, host_ms(999)));
  EXPECT_TRUE(schedule.is_due(bus, host_ms(1000)));
  EXPECT_FALSE(schedule.is_due(bus, host_ms(1001)));
}

TEST(ReopenSchedule, TriesAsSoonAsSomethingIsPluggedIn) {
  ManualLinkClock clock;
  FakeDongle bus(clock);
  ReopenSchedule schedule;
  EXPECT_TRUE(schedule.is_due(bus, host_ms(0)));
  bus.has_news = true;
  EXPECT_TRUE(schedule.is_due(bus, host_ms(300)));
  EXPECT_FALSE(schedule.is_due(bus, host_ms(1299)));  // a second after that attempt
  EXPECT_TRUE(schedule.is_due(bus, host_ms(1300)));
}

}  // namespace
}  // namespace swiftlet

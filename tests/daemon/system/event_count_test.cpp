// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/system/event_count.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

TEST(EventCount, DoesNotSleepOverAStrokeThatCameBefore) {
  EventCount event_count;
  const std::uint32_t epoch = event_count.epoch();
  event_count.notify();
  event_count.wait(epoch);
  EXPECT_NE(event_count.epoch(), epoch);
}

TEST(EventCount, SleepsNoLongerThanTold) {
  EventCount event_count;
  const steady_clock::time_point wake_at = steady_clock::now() + milliseconds(30);
  while (steady_clock::now() < wake_at) event_count.wait(event_count.epoch(), wake_at);
  EXPECT_EQ(event_count.epoch(), 0U);
}

TEST(EventCount, WakesWhoSleeps) {
  EventCount event_count;
  const steady_clock::time_point began = steady_clock::now();
  const std::uint32_t epoch = event_count.epoch();
  std::jthread ringer([&event_count] {
    std::this_thread::sleep_for(milliseconds(20));
    event_count.notify();
  });
  while (event_count.epoch() == epoch) event_count.wait(epoch, began + std::chrono::minutes(1));
  EXPECT_LT(steady_clock::now() - began, std::chrono::seconds(30));
}

TEST(EventCount, NoStrokeIsMissedHoweverTheyFall) {
  constexpr std::uint32_t kNotifications = 20'000;
  EventCount there;
  EventCount back;
  std::jthread echo([&] {
    for (std::uint32_t epoch = 0; epoch < kNotifications; ++epoch) {
      while (there.epoch() == epoch) there.wait(epoch);
      back.notify();
    }
  });
  for (std::uint32_t epoch = 0; epoch < kNotifications; ++epoch) {
    there.notify();
    while (back.epoch() == epoch) back.wait(epoch);
  }
  EXPECT_EQ(back.epoch(), kNotifications);
}

}  // namespace
}  // namespace swiftlet

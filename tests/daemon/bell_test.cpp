// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/bell.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

TEST(Bell, DoesNotSleepOverAStrokeThatCameBefore) {
  Bell bell;
  const std::uint32_t heard = bell.strokes();
  bell.ring();
  bell.wait(heard);
  EXPECT_NE(bell.strokes(), heard);
}

TEST(Bell, SleepsNoLongerThanTold) {
  Bell bell;
  const steady_clock::time_point wake_at = steady_clock::now() + milliseconds(30);
  while (steady_clock::now() < wake_at) bell.wait(bell.strokes(), wake_at);
  EXPECT_EQ(bell.strokes(), 0U);
}

TEST(Bell, WakesWhoSleeps) {
  Bell bell;
  const steady_clock::time_point began = steady_clock::now();
  const std::uint32_t heard = bell.strokes();
  std::jthread ringer([&bell] {
    std::this_thread::sleep_for(milliseconds(20));
    bell.ring();
  });
  while (bell.strokes() == heard) bell.wait(heard, began + std::chrono::minutes(1));
  EXPECT_LT(steady_clock::now() - began, std::chrono::seconds(30));
}

TEST(Bell, NoStrokeIsMissedHoweverTheyFall) {
  constexpr std::uint32_t kStrokes = 20'000;
  Bell there;
  Bell back;
  std::jthread echo([&] {
    for (std::uint32_t heard = 0; heard < kStrokes; ++heard) {
      while (there.strokes() == heard) there.wait(heard);
      back.ring();
    }
  });
  for (std::uint32_t heard = 0; heard < kStrokes; ++heard) {
    there.ring();
    while (back.strokes() == heard) back.wait(heard);
  }
  EXPECT_EQ(back.strokes(), kStrokes);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/link/link_clock.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

TEST(SystemLinkClock, KnowsTheMonotonicTimeOfItsStamps) {
  using std::chrono::steady_clock;
  SystemLinkClock clock;
  const MonotonicTime before = steady_clock::now();
  const HostTime stamp = clock.now();
  const MonotonicTime after = steady_clock::now();
  constexpr std::chrono::microseconds kRounding{1};
  EXPECT_GT(clock.monotonic_time_of(stamp), before - kRounding);
  EXPECT_LE(clock.monotonic_time_of(stamp), after);
  constexpr std::chrono::milliseconds kEarlier{3};
  EXPECT_EQ(clock.monotonic_time_of(stamp) - clock.monotonic_time_of(stamp - kEarlier), kEarlier);
}

}  // namespace
}  // namespace swiftlet

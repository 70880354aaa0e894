// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/pacer.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const MonotonicTime kNow{seconds(500)};

HostTime stamp(milliseconds since_start) { return HostTime(seconds(1'700'000'000) + since_start); }

TEST(Pacer, KeepsTheDistanceOfTheStampsDividedByTheRate) {
  Pacer pacer(20.0);
  EXPECT_EQ(pacer.due(stamp(milliseconds(0)), kNow), kNow);
  EXPECT_EQ(pacer.due(stamp(milliseconds(100)), kNow), kNow + milliseconds(5));
  EXPECT_EQ(pacer.due(stamp(milliseconds(300)), kNow), kNow + milliseconds(15));
}

TEST(Pacer, CatchesUpAfterADelayInsteadOfShiftingTheRest) {
  Pacer pacer(1.0);
  static_cast<void>(pacer.due(stamp(milliseconds(0)), kNow));
  EXPECT_EQ(pacer.due(stamp(milliseconds(100)), kNow + seconds(9)), kNow + milliseconds(100));
}

TEST(Pacer, WaitsNoLongerThanAMinuteForAClockThatWasSet) {
  Pacer pacer(0.5);
  static_cast<void>(pacer.due(stamp(milliseconds(0)), kNow));
  EXPECT_EQ(pacer.due(stamp(std::chrono::hours(24 * 365)), kNow), kNow + std::chrono::minutes(2));
}

TEST(Pacer, WaitsForNothingWhenStampsGoBack) {
  Pacer pacer(1.0);
  static_cast<void>(pacer.due(stamp(milliseconds(1000)), kNow));
  EXPECT_EQ(pacer.due(stamp(milliseconds(0)), kNow), kNow);
  EXPECT_EQ(pacer.due(stamp(milliseconds(100)), kNow), kNow + milliseconds(100));
}

}  // namespace
}  // namespace swiftlet

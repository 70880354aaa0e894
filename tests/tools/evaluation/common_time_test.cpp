// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/common_time.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

namespace swiftlet {
namespace {

HostTime at_second_of_day(int second) { return HostTime(std::chrono::seconds(second)); }

TEST(CommonTime, ASpanIsFromTheEarliestStampToTheLatest) {
  const std::vector<HostTime> stamps{at_second_of_day(7), at_second_of_day(2), at_second_of_day(5)};
  EXPECT_EQ(span_of(stamps).first, at_second_of_day(2));
  EXPECT_EQ(span_of(stamps).last, at_second_of_day(7));
  const StampedPath path({{at_second_of_day(4), Pose2()}, {at_second_of_day(3), Pose2()}});
  EXPECT_EQ(span_of(path).first, at_second_of_day(3));
  EXPECT_EQ(span_of(path).last, at_second_of_day(4));
}

TEST(CommonTime, WhatHasNothingInCommonIsRefusedWithBothTimes) {
  const Error refusal = nothing_in_common("truth.tum", "lacks it", {at_second_of_day(5), at_second_of_day(6)},
                                          {at_second_of_day(1), at_second_of_day(2)});
  EXPECT_EQ(refusal.code, ErrorCode::kInvalidInput);
  EXPECT_EQ(refusal.message,
            "truth.tum: lacks it; its stamps are from 5.000000 to 6.000000 s, the trajectory's from 1.000000 "
            "to 2.000000 s; are they of one run and one clock?");
}

}  // namespace
}  // namespace swiftlet

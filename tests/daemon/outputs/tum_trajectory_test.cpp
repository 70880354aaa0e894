// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/tum_trajectory.hpp"

#include <gmock/gmock.h>

namespace swiftlet {
namespace {

std::string line_of(std::int64_t nanoseconds, const Pose2& pose) {
  std::string text;
  append_tum_line(text, HostTime(Duration(nanoseconds)), pose);
  return text;
}

TEST(TumTrajectory, KeepsEveryDigitOfAUnixTime) {
  EXPECT_EQ(line_of(1'627'252'323'513'927'000, {1.5, -2.25, 0.0}),
            "1627252323.513927 1.500000 -2.250000 0 0 0 0.000000000 1.000000000\n");
}

TEST(TumTrajectory, RoundsToTheMicrosecond) {
  EXPECT_THAT(line_of(999'999'600, {}), testing::StartsWith("1.000000 "));
  EXPECT_THAT(line_of(1'000'000'400, {}), testing::StartsWith("1.000000 "));
  EXPECT_THAT(line_of(-500'000, {}), testing::StartsWith("-0.000500 "));
}

TEST(TumTrajectory, WritesTheYawAsAQuaternion) {
  EXPECT_THAT(line_of(0, {0.0, 0.0, kPi / 2.0}), testing::EndsWith(" 0 0 0 0.707106781 0.707106781\n"));
}

TEST(TumTrajectory, Appends) {
  std::string text = "before\n";
  append_tum_line(text, {}, {});
  EXPECT_THAT(text, testing::StartsWith("before\n0.000000 "));
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/laser_log/line_times.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kPeriod = milliseconds(200);

std::vector<CarmenOdometry> lines_at(const std::vector<Duration>& stamps) {
  std::vector<CarmenOdometry> lines;
  for (const Duration stamp : stamps) lines.push_back({HostTime(seconds(1'000'000'000) + stamp), {}, 0.0});
  return lines;
}

Duration since_first(const std::vector<CarmenOdometry>& lines, DeviceTime time) {
  return time.time_since_epoch() - lines.front().stamp.time_since_epoch();
}

TEST(RegularTimes, KeepsStampsThatAreRegular) {
  std::vector<Duration> stamps;
  for (int i = 0; i < 50; ++i) stamps.push_back(i * kPeriod);
  const std::vector<CarmenOdometry> lines = lines_at(stamps);
  const std::vector<DeviceTime> times = regular_times(lines);
  ASSERT_EQ(times.size(), 50U);
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_EQ(since_first(lines, times[i]), stamps[i]) << i;
}

TEST(RegularTimes, SpreadsBunchesEvenly) {
  std::vector<Duration> stamps;  // three lines at a time, a millisecond apart
  for (int i = 0; i < 60; ++i) stamps.push_back(i / 3 * 3 * kPeriod + milliseconds(i % 3));
  const std::vector<CarmenOdometry> lines = lines_at(stamps);
  const std::vector<DeviceTime> times = regular_times(lines);
  for (std::size_t i = 11; i < 50; ++i)
    EXPECT_NEAR(to_seconds(times[i] - times[i - 1]), to_seconds(kPeriod), 0.03) << i;
}

TEST(RegularTimes, LeavesPausesWhereTheyAre) {
  std::vector<Duration> stamps;
  for (int i = 0; i < 40; ++i) stamps.push_back(i * kPeriod + (i >= 20 ? seconds(60) : seconds(0)));
  const std::vector<CarmenOdometry> lines = lines_at(stamps);
  const std::vector<DeviceTime> times = regular_times(lines);
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_EQ(since_first(lines, times[i]), stamps[i]) << i;
}

TEST(RegularTimes, OfNoLinesAreNone) { EXPECT_TRUE(regular_times({}).empty()); }

}  // namespace
}  // namespace swiftlet

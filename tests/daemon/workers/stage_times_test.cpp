// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/stage_times.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "tests/support/manual_clock.hpp"

namespace swiftlet {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

TEST(StageHistogram, SaysNothingWhenNothingWasRecorded) {
  const StageSummary summary = StageHistogram().summary("map");
  EXPECT_EQ(summary.name, "map");
  EXPECT_EQ(summary.count, 0U);
  EXPECT_EQ(summary.max_ms, 0.0);
}

TEST(StageHistogram, KnowsMeanAndMaximumExactlyAndPercentilesToAThirtySecond) {
  StageHistogram histogram;
  for (int i = 1; i <= 1000; ++i) histogram.record(microseconds(i));
  const StageSummary summary = histogram.summary("frontend");
  EXPECT_EQ(summary.count, 1000U);
  EXPECT_DOUBLE_EQ(summary.mean_ms, 0.5005);
  EXPECT_DOUBLE_EQ(summary.max_ms, 1.0);
  EXPECT_GE(summary.p50_ms, 0.500);
  EXPECT_LE(summary.p50_ms, 0.500 * (1.0 + 1.0 / 32.0));
  EXPECT_GE(summary.p99_ms, 0.990);
  EXPECT_LE(summary.p99_ms, 1.0);
  EXPECT_GE(summary.p999_ms, 0.999);
  EXPECT_LE(summary.p999_ms, 1.0);
}

TEST(StageHistogram, IsWrittenDownByTheBucketsThatHoldAnything) {
  StageHistogram histogram;
  histogram.record(Duration(5));
  histogram.record(Duration(5));
  histogram.record(milliseconds(3));
  const StageBuckets written = histogram.buckets("input");
  EXPECT_EQ(written.name, "input");
  ASSERT_EQ(written.buckets.size(), 2U);
  EXPECT_EQ(written.buckets[0].upper_ns, 5U);
  EXPECT_EQ(written.buckets[0].count, 2U);
  EXPECT_GE(written.buckets[1].upper_ns, 3'000'000U);
  EXPECT_LE(written.buckets[1].upper_ns, 3'093'750U);
  EXPECT_EQ(written.buckets[1].count, 1U);
}

TEST(PoseLatency, CountsWhatTookLongerThanTheDeadline) {
  PoseLatency latency(milliseconds(2));
  latency.record(milliseconds(2));
  latency.record(milliseconds(2) + Duration(1));
  EXPECT_EQ(latency.missed(), 1U);
  EXPECT_EQ(latency.times().summary("").count, 2U);
}

TEST(StageHistogram, PercentilesHoldFromNanosecondsToMinutes) {
  for (std::int64_t ns = 1; ns < 600'000'000'000; ns += ns / 3 + 1) {
    StageHistogram histogram;
    histogram.record(Duration(ns));
    histogram.record(std::chrono::minutes(15));  // so that the median is not cut at the maximum
    const double exact_ms = static_cast<double>(ns) * 1e-6;
    const double p50_ms = histogram.summary("").p50_ms;
    EXPECT_GE(p50_ms, exact_ms * (1.0 - 1e-12)) << ns;
    EXPECT_LE(p50_ms, exact_ms * (1.0 + 1.0 / 32.0)) << ns;
  }
}

TEST(StageHistogram, TakesWhatLiesBeyondItsRange) {
  StageHistogram histogram;
  histogram.record(Duration(-5));
  histogram.record(std::chrono::hours(10));
  const StageSummary summary = histogram.summary("");
  EXPECT_EQ(summary.count, 2U);
  EXPECT_EQ(summary.p50_ms, 0.0);
  EXPECT_DOUBLE_EQ(summary.max_ms, 36e6);
}

TEST(StageTimer, RecordsTheTimeUntilItsEnd) {
  ManualClock clock;
  StageHistogram histogram;
  {
    const StageTimer timer(clock, histogram);
    clock.advance(milliseconds(7));
  }
  EXPECT_DOUBLE_EQ(histogram.summary("").max_ms, 7.0);
}

}  // namespace
}  // namespace swiftlet

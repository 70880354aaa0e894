// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/latency/latency_picture.hpp"

#include <gtest/gtest.h>

#include "tests/tools/latency/timing_reports.hpp"

namespace swiftlet {
namespace {

constexpr Colour kBar{68, 119, 170};

/// Columns of the picture in which a bar stands, and how many pixels of it.
std::vector<std::pair<int, int>> bars_in(const RgbImage& image) {
  std::vector<std::pair<int, int>> bars;
  for (int x = 0; x < image.width(); ++x) {
    int height = 0;
    for (int y = 0; y < image.height(); ++y) height += image.at(x, y) == kBar ? 1 : 0;
    if (height > 0) bars.emplace_back(x, height);
  }
  return bars;
}

TEST(LatencyPicture, HasBarsWhereCallsTookSoLongHigherWhereTheyAreMore) {
  TimingReport report = late_once();
  report.stages[0].p50_ms = report.stages[0].p99_ms = report.stages[0].p999_ms =
      0.001;  // marks out of the way
  report.pose_deadline_ms.reset();
  const auto bars = bars_in(draw_latencies(report));
  ASSERT_EQ(bars.size(), 4U) << "two, two pixels wide";
  EXPECT_EQ(bars[0].first, 150 + 200) << "100 us is two tenfolds above 1 us";
  EXPECT_EQ(bars[2].first, 150 + 369) << "5 ms";
  EXPECT_GT(bars[0].second, 4 * bars[2].second);
}

TEST(LatencyPicture, GrowsWithTheStages) {
  TimingReport report = late_once();
  const int one = draw_latencies(report).height();
  report.stages.push_back(report.stages[0]);
  report.buckets.push_back(report.buckets[0]);
  EXPECT_GT(draw_latencies(report).height(), one);
  EXPECT_GT(draw_latencies(TimingReport{}).height(), 0);
}

}  // namespace
}  // namespace swiftlet

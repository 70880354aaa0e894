// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/latency/latency_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

/// Pixels in the colour of names and marks' lines.
int ink_in(const RgbImage& image) {
  constexpr Colour kInk{40, 44, 52};
  int count = 0;
  for (int x = 0; x < image.width(); ++x)
    for (int y = 0; y < image.height(); ++y) count += image.at(x, y) == kInk ? 1 : 0;
  return count;
}

TEST(LatencyPicture, NamesOfNeighbouringMarksDoNotCoverEachOther) {
  TimingReport report = late_once();
  report.pose_deadline_ms.reset();
  StageSummary& stage = report.stages[0];
  stage.count = 1000;
  const auto ink_with = [&](double p50_ms, double p99_ms, double p999_ms) {
    stage.p50_ms = p50_ms;
    stage.p99_ms = p99_ms;
    stage.p999_ms = p999_ms;
    return ink_in(draw_latencies(report));
  };
  const auto ms_at = [](int px) { return 0.1 * std::pow(10.0, px / 100.0); };  // from that of 0.1 ms
  const int apart = ink_with(ms_at(-100), ms_at(0), ms_at(100));
  EXPECT_GE(ink_with(ms_at(0), ms_at(5), ms_at(10)), apart);
  EXPECT_GE(ink_with(ms_at(0), ms_at(8), ms_at(100)), apart);
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

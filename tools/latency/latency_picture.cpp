// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/latency/latency_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace swiftlet {
namespace {

constexpr Colour kPaper{255, 255, 255};
constexpr Colour kInk{40, 44, 52};
constexpr Colour kFaint{222, 226, 232};
constexpr Colour kBar{68, 119, 170};
constexpr Colour kDeadline{187, 68, 51};

constexpr int kLeft = 150;
constexpr int kPlotWidth = 700;  // 100 pixels to each tenfold
constexpr int kRight = 30;
constexpr int kTop = 46;
constexpr int kStripHeight = 70;
constexpr int kStripGap = 26;
constexpr int kBottom = 40;
constexpr double kTextPx = 12.0;
constexpr double kFirstDecade = 3.0;  // 1 us, in ns
constexpr std::array<const char*, 8> kDecades{"1 us",  "10 us", "0.1 ms", "1 ms",
                                              "10 ms", "0.1 s", "1 s",    "10 s"};

double x_of(double ns) {
  const double decades = std::log10(std::max(ns, 1.0)) - kFirstDecade;
  return kLeft + std::clamp(decades * kPlotWidth / (kDecades.size() - 1), 0.0, double{kPlotWidth});
}

/// Calls in each column of pixels.
std::vector<std::uint64_t> columns_of(const StageBuckets& stage) {
  std::vector<std::uint64_t> columns(kPlotWidth + 1, 0);
  for (const auto& [upper_ns, count] : stage.buckets)
    columns[static_cast<std::size_t>(x_of(static_cast<double>(upper_ns))) - kLeft] += count;
  return columns;
}

void draw_bars(RgbImage& image, const StageBuckets& stage, int base) {
  const std::vector<std::uint64_t> columns = columns_of(stage);
  const double most =
      std::log10(static_cast<double>(*std::max_element(columns.begin(), columns.end())) + 1.0);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] == 0) continue;
    const double share = std::log10(static_cast<double>(columns[i]) + 1.0) / most;
    const int height = std::max(2, static_cast<int>(std::lround(share * (kStripHeight - 16))));
    fill_rectangle(image, kLeft + static_cast<int>(i), base - height, 2, height, kBar);
  }
}

void draw_mark(RgbImage& image, double ms, const std::string& name, int base, const Colour& colour) {
  const double x = x_of(ms * 1e6);
  draw_line(image, {x, base - kStripHeight + 12.0}, {x, double(base)}, {colour, 1.0, 1.0});
  draw_text_with_halo(image, {x + 3.0, base - kStripHeight + 20.0}, 9.0, name, colour, kPaper);
}

void draw_axis(RgbImage& image, int bottom) {
  for (std::size_t i = 0; i < kDecades.size(); ++i) {
    const double x = kLeft + 100.0 * static_cast<double>(i);
    draw_line(image, {x, double{kTop}}, {x, double(bottom)}, {kFaint, 1.0, 1.0});
    draw_text(image, {x - text_width_px(kTextPx, kDecades[i]) / 2.0, bottom + 20.0}, kTextPx, kDecades[i],
              kInk);
  }
}

}  // namespace

RgbImage draw_latencies(const TimingReport& report) {
  const int strips = static_cast<int>(report.buckets.size());
  const int bottom = kTop + strips * (kStripHeight + kStripGap);
  RgbImage image(kLeft + kPlotWidth + kRight, bottom + kBottom, kPaper);
  draw_text(image, {20.0, 26.0}, 14.0, "calls by the time they took, both logarithmic", kInk);
  draw_axis(image, bottom);
  for (int i = 0; i < strips; ++i) {
    const StageBuckets& stage = report.buckets[static_cast<std::size_t>(i)];
    const StageSummary& summary = report.stages[static_cast<std::size_t>(i)];
    const int base = kTop + i * (kStripHeight + kStripGap) + kStripHeight;
    std::string name = stage.name;
    std::replace(name.begin(), name.end(), '_', ' ');
    draw_text(image, {20.0, base - 8.0}, kTextPx, name, kInk);
    draw_bars(image, stage, base);
    draw_line(image, {double{kLeft}, double(base)}, {double{kLeft + kPlotWidth}, double(base)},
              {kInk, 1.0, 1.0});
    draw_mark(image, summary.p50_ms, "50%", base, kInk);
    if (summary.count >= 100) draw_mark(image, summary.p99_ms, "99%", base, kInk);
    if (summary.count >= 1000) draw_mark(image, summary.p999_ms, "99.9%", base, kInk);
    if (stage.name == "frame_to_pose" && report.pose_deadline_ms)
      draw_mark(image, *report.pose_deadline_ms, "deadline", base, kDeadline);
  }
  return image;
}

}  // namespace swiftlet

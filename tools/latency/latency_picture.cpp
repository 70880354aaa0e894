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
constexpr double kMarkTextPx = 9.0;
constexpr double kMarkRowHeight = 13.0;
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

struct Mark {
  double x_px = 0.0;
  std::string name;  // to the right of the mark's line, at its top
  Colour colour;
  int row = 0;  // of the name, from below

  [[nodiscard]] double end_px() const { return x_px + 6.0 + text_width_px(kMarkTextPx, name); }
};

std::vector<Mark> marks_of(const StageSummary& stage) {
  std::vector<Mark> marks{{x_of(stage.p50_ms * 1e6), "50%", kInk}};
  if (stage.count >= 100) marks.push_back({x_of(stage.p99_ms * 1e6), "99%", kInk});
  if (stage.count >= 1000) marks.push_back({x_of(stage.p999_ms * 1e6), "99.9%", kInk});
  return marks;
}

/// A name goes above all marks that it would run into.
void draw_marks(RgbImage& image, std::vector<Mark> marks, int base) {
  std::stable_sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.x_px < b.x_px; });
  for (std::size_t i = marks.size(); i-- > 0;) {
    Mark& mark = marks[i];
    for (std::size_t k = i + 1; k < marks.size() && marks[k].x_px < mark.end_px(); ++k)
      mark.row = std::max(mark.row, marks[k].row + 1);
    const double top = base - kStripHeight + 12.0 - mark.row * kMarkRowHeight;
    draw_line(image, {mark.x_px, top}, {mark.x_px, double(base)}, {mark.colour, 1.0, 1.0});
    draw_text_with_halo(image, {mark.x_px + 3.0, top + 8.0}, kMarkTextPx, mark.name, mark.colour, kPaper);
  }
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
    std::vector<Mark> marks = marks_of(summary);
    if (stage.name == "frame_to_pose" && report.pose_deadline_ms)
      marks.push_back({x_of(*report.pose_deadline_ms * 1e6), "deadline", kDeadline});
    draw_marks(image, std::move(marks), base);
  }
  return image;
}

}  // namespace swiftlet

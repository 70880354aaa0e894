// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/map_legend.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace swiftlet {

namespace {

constexpr double kTextPx = 13.0;
constexpr double kEdgePx = 24.0;
constexpr double kGapPx = 34.0;
constexpr double kScaleBarMostPx = 320.0;
constexpr int kTimeBarPx = 120;

std::string minutes_and_seconds(Duration duration) {
  const auto seconds = std::chrono::round<std::chrono::seconds>(duration).count();
  const std::string rest = std::to_string(seconds % 60);
  return std::to_string(seconds / 60) + ":" + (rest.size() < 2 ? "0" : "") + rest;
}

/// Writes one entry after the other along a line, from left to right, while there is room.
class LegendLine {
 public:
  LegendLine(RgbImage& image, int top_px)
      : image_(image), middle_(top_px + kLegendHeightPx / 2.0), left_(kEdgePx) {}

  void scale_bar(double px_per_m) {
    const double length_m = scale_bar_length_m(px_per_m, kScaleBarMostPx);
    const double end = left_ + length_m * px_per_m;
    const Pen pen{map_style::kInk, 2.0, 1.0};
    draw_line(image_, {left_, middle_}, {end, middle_}, pen);
    for (const double x : {left_, end}) draw_line(image_, {x, middle_ - 6.0}, {x, middle_ + 6.0}, pen);
    left_ = end + 12.0;
    text(std::to_string(std::lround(length_m)) + " m");
  }

  void time_scale(Duration duration) {
    const std::string end = minutes_and_seconds(duration);
    if (!fits(text_width_px(kTextPx, "path 0:00" + end) + kTimeBarPx + 36.0)) return;
    text("path 0:00", 12.0);
    for (int x = 0; x < kTimeBarPx; ++x) {
      const Pen pen{map_style::time_colour(static_cast<double>(x) / kTimeBarPx), 5.0, 1.0};
      draw_line(image_, {left_ + x, middle_}, {left_ + x + 1.0, middle_}, pen);
    }
    left_ += kTimeBarPx + 12.0;
    text(end);
  }

  void key(const Pen& pen, double dash_px, const std::string& name) {
    constexpr double kSamplePx = 30.0;
    if (!fits(kSamplePx + 10.0 + text_width_px(kTextPx, name))) return;
    draw_dashed_line(image_, {left_, middle_}, {left_ + kSamplePx, middle_}, dash_px, pen);
    left_ += kSamplePx + 10.0;
    text(name);
  }

 private:
  [[nodiscard]] bool fits(double width_px) const { return left_ + width_px <= image_.width() - kEdgePx; }
  void text(const std::string& words, double gap_px = kGapPx) {
    draw_text(image_, {left_, middle_ + kTextPx / 2.0}, kTextPx, words, map_style::kInk);
    left_ += text_width_px(kTextPx, words) + gap_px;
  }

  RgbImage& image_;
  double middle_;
  double left_;
};

}  // namespace

double scale_bar_length_m(double px_per_m, double max_px) {
  const double max_m = max_px / px_per_m;
  const double decade = std::pow(10.0, std::floor(std::log10(max_m)));
  for (const double factor : {5.0, 2.0})
    if (factor * decade <= max_m) return std::max(factor * decade, 1.0);
  return std::max(decade, 1.0);
}

void draw_legend(RgbImage& image, int top_px, double px_per_m, const MapScene& scene) {
  constexpr double kUnbroken = 1e9;
  fill_rectangle(image, 0, top_px, image.width(), kLegendHeightPx, map_style::kPaper);
  LegendLine line(image, top_px);
  line.scale_bar(px_per_m);
  line.time_scale(scene.duration);
  line.key(map_style::kOdometry, kUnbroken, "odometry");
  if (!scene.walls.empty()) line.key(map_style::kWall, kUnbroken, "walls");
  if (!scene.closures.empty())
    line.key(map_style::kClosure, kUnbroken, std::to_string(scene.closures.size()) + " loop closures");
  if (!scene.dropped_closures.empty())
    line.key(map_style::kDropped, 6.0, std::to_string(scene.dropped_closures.size()) + " dropped");
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/map_legend.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

namespace swiftlet {

namespace {

constexpr double kTextPx = 13.0;
constexpr double kEdgePx = 24.0;
constexpr double kGapPx = 34.0;
constexpr double kScaleBarMostPx = 320.0;
constexpr double kScaleBarShare = 0.2;  // of the width, at most: the keys need the rest
constexpr int kTimeBarPx = 120;
constexpr double kTickPx = 7.0;
constexpr double kTickTextPx = 11.0;

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
    const double length_m =
        scale_bar_length_m(px_per_m, std::min(kScaleBarMostPx, image_.width() * kScaleBarShare));
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

std::string title_text(const MapScene& scene) {
  std::string text = scene.title;
  if (scene.scans.empty()) return text;
  const std::chrono::sys_time<Duration> began(scene.began.time_since_epoch());
  const auto day = std::chrono::floor<std::chrono::days>(began);
  const std::chrono::year_month_day date(day);
  const auto minutes = std::chrono::floor<std::chrono::minutes>(began - day).count();
  std::array<char, 96> rest{};
  std::snprintf(rest.data(), rest.size(), "%s%04d-%02u-%02u %02d:%02d utc, %s min, %.0f m",
                text.empty() ? "" : "   ", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()), static_cast<int>(minutes / 60),
                static_cast<int>(minutes % 60), minutes_and_seconds(scene.duration).c_str(), scene.length_m);
  return text + rest.data();
}

void draw_title(RgbImage& image, int top_px, const MapScene& scene, bool cuts_odometry) {
  fill_rectangle(image, 0, top_px, image.width(), kTitleHeightPx, map_style::kPaper);
  const std::string text = title_text(scene) + (cuts_odometry ? "   (odometry is cut off at the edge)" : "");
  draw_text(image, {kEdgePx, top_px + kTextPx + 4.0}, kTextPx, text, map_style::kInk);
}

void draw_axes(RgbImage& image, const MapView& view) {
  const double step_m = scale_bar_length_m(view.px_per_m(), kScaleBarMostPx / 2.0);
  const Pen pen{map_style::kInk, 1.2, 0.8};
  const PixelPoint origin = view.pixel({0.0, 0.0});
  const double step_px = step_m * view.px_per_m();
  const auto label = [&](const PixelPoint& at, double metres) {
    draw_text_with_halo(image, at, kTickTextPx, std::to_string(std::lround(metres)), map_style::kInk,
                        map_style::kPaper);
  };
  const double bottom = view.height_px();
  for (double n = std::ceil(-origin.x / step_px); origin.x + n * step_px < view.width_px(); ++n) {
    const double x = origin.x + n * step_px;
    draw_line(image, {x, bottom}, {x, bottom - kTickPx}, pen);
    label({x + 3.0, bottom - 3.0}, n * step_m);
  }
  for (double n = std::ceil((origin.y - bottom) / step_px); origin.y - n * step_px > 0.0; ++n) {
    const double y = origin.y - n * step_px;
    draw_line(image, {0.0, y}, {kTickPx, y}, pen);
    label({kTickPx + 3.0, y + kTickTextPx / 2.0}, n * step_m);
  }
}

void draw_legend(RgbImage& image, int top_px, double px_per_m, const MapScene& scene) {
  constexpr double kUnbroken = 1e9;
  fill_rectangle(image, 0, top_px, image.width(), kLegendHeightPx, map_style::kPaper);
  LegendLine line(image, top_px);
  line.scale_bar(px_per_m);
  if (!scene.scans.empty()) {
    line.time_scale(scene.duration);
    line.key(map_style::kOdometry, kUnbroken, "odometry");
  }
  if (!scene.walls.empty()) line.key(map_style::kWall, kUnbroken, "walls");
  if (!scene.closures.empty())
    line.key(map_style::kClosure, kUnbroken, std::to_string(scene.closures.size()) + " loop closures");
  if (!scene.dropped_closures.empty())
    line.key(map_style::kDropped, 6.0, std::to_string(scene.dropped_closures.size()) + " dropped");
}

}  // namespace swiftlet

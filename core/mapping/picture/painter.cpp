// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/painter.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/mapping/picture/stroke_font.hpp"

namespace swiftlet {

namespace {

/// Distance from p to the segment a-b.
double distance_px(const PixelPoint& p, const PixelPoint& a, const PixelPoint& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length_squared = dx * dx + dy * dy;
  const double along = length_squared > 0.0
                           ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length_squared, 0.0, 1.0)
                           : 0.0;
  return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

struct PixelBox {
  int left, top, right, bottom;  ///< right and bottom excluded
};
PixelBox box_around(const RgbImage& image, const PixelPoint& a, const PixelPoint& b, double margin_px) {
  const auto column = [&](double x) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(image.width())));
  };
  const auto row = [&](double y) {
    return static_cast<int>(std::clamp(y, 0.0, static_cast<double>(image.height())));
  };
  return {column(std::floor(std::min(a.x, b.x) - margin_px)), row(std::floor(std::min(a.y, b.y) - margin_px)),
          column(std::ceil(std::max(a.x, b.x) + margin_px)), row(std::ceil(std::max(a.y, b.y) + margin_px))};
}

/// Everything within `radius_px` of the segment a-b.
void fill_capsule(RgbImage& image, const PixelPoint& a, const PixelPoint& b, double radius_px,
                  const Colour& colour, double opacity) {
  const PixelBox box = box_around(image, a, b, radius_px + 1.0);
  for (int y = box.top; y < box.bottom; ++y) {
    for (int x = box.left; x < box.right; ++x) {
      const double distance = distance_px({x + 0.5, y + 0.5}, a, b);
      const double coverage = std::clamp(radius_px + 0.5 - distance, 0.0, 1.0);
      if (coverage > 0.0) image.at(x, y) = mix(image.at(x, y), colour, coverage * opacity);
    }
  }
}

double text_pen_px(double size_px) { return std::max(size_px * 0.115, 1.1); }

void write(RgbImage& image, const PixelPoint& baseline, double size_px, std::string_view text,
           const Pen& pen) {
  const double scale = size_px / stroke_font::kHeight;
  double left = baseline.x;
  const auto pixel = [&](const stroke_font::Point& p) {
    return PixelPoint{left + p.x * scale, baseline.y - p.y * scale};
  };
  for (const char letter : text) {
    const stroke_font::Glyph& glyph = stroke_font::glyph_of(letter);
    for (const stroke_font::Stroke& stroke : glyph.strokes) {
      if (stroke.size() == 1) draw_line(image, pixel(stroke[0]), pixel(stroke[0]), pen);
      for (std::size_t i = 1; i < stroke.size(); ++i)
        draw_line(image, pixel(stroke[i - 1]), pixel(stroke[i]), pen);
    }
    left += (glyph.width + stroke_font::kSpacing) * scale;
  }
}

}  // namespace

Colour mix(const Colour& a, const Colour& b, double share) {
  const auto channel = [share](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
  };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

RgbImage::RgbImage(int width, int height, const Colour& background) : width_(width), height_(height) {
  SWIFTLET_CHECK(width > 0 && height > 0, "an image has pixels");
  pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background);
}

void draw_line(RgbImage& image, const PixelPoint& a, const PixelPoint& b, const Pen& pen) {
  fill_capsule(image, a, b, pen.width_px / 2.0, pen.colour, pen.opacity);
}

void draw_disc(RgbImage& image, const PixelPoint& centre, double radius_px, const Colour& colour) {
  fill_capsule(image, centre, centre, radius_px, colour, 1.0);
}

void draw_dashed_line(RgbImage& image, const PixelPoint& a, const PixelPoint& b, double dash_px,
                      const Pen& pen) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const auto point_at = [&](double along) {
    const double share = length > 0.0 ? std::min(along / length, 1.0) : 0.0;
    return PixelPoint{a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
  };
  const int dashes = static_cast<int>(std::ceil(length / (2.0 * dash_px)));
  for (int i = 0; i < dashes; ++i)
    draw_line(image, point_at(2.0 * i * dash_px), point_at((2.0 * i + 1.0) * dash_px), pen);
}

void fill_rectangle(RgbImage& image, int left, int top, int width, int height, const Colour& colour) {
  for (int y = std::max(top, 0); y < std::min(top + height, image.height()); ++y)
    for (int x = std::max(left, 0); x < std::min(left + width, image.width()); ++x) image.at(x, y) = colour;
}

void draw_text(RgbImage& image, const PixelPoint& baseline, double size_px, std::string_view text,
               const Colour& colour) {
  write(image, baseline, size_px, text, {colour, text_pen_px(size_px), 1.0});
}

void draw_text_with_halo(RgbImage& image, const PixelPoint& baseline, double size_px, std::string_view text,
                         const Colour& colour, const Colour& halo) {
  write(image, baseline, size_px, text, {halo, text_pen_px(size_px) + 5.0, 1.0});
  draw_text(image, baseline, size_px, text, colour);
}

double text_width_px(double size_px, std::string_view text) {
  double width = 0.0;
  for (const char letter : text) width += stroke_font::glyph_of(letter).width + stroke_font::kSpacing;
  return text.empty() ? 0.0 : (width - stroke_font::kSpacing) * size_px / stroke_font::kHeight;
}

}  // namespace swiftlet

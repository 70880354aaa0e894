// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace swiftlet {

struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  bool operator==(const Colour&) const = default;
};

/// `share` 0 gives a, 1 gives b.
[[nodiscard]] Colour mix(const Colour& a, const Colour& b, double share);

/// A place in an image in pixels: x to the right, y down, the corner of the top left pixel is (0, 0).
struct PixelPoint {
  double x = 0.0;
  double y = 0.0;
};

/// Eight bits a channel, rows from the top. Allocates in the constructor only.
class RgbImage {
 public:
  RgbImage(int width, int height, const Colour& background);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Precondition: inside the image.
  [[nodiscard]] const Colour& at(int x, int y) const { return pixels_[offset(x, y)]; }
  Colour& at(int x, int y) { return pixels_[offset(x, y)]; }
  /// Row by row from the top.
  [[nodiscard]] std::span<const Colour> pixels() const { return pixels_; }

 private:
  [[nodiscard]] std::size_t offset(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_;
  int height_;
  std::vector<Colour> pixels_;
};

struct Pen {
  Colour colour;
  double width_px = 1.0;
  double opacity = 1.0;
};

// All shapes have smooth edges (each pixel takes the colour by the share of it that is covered, to within
// the distance of its centre) and may reach beyond the image.
void draw_line(RgbImage& image, const PixelPoint& a, const PixelPoint& b, const Pen& pen);
void draw_disc(RgbImage& image, const PixelPoint& centre, double radius_px, const Colour& colour);
/// `dash_px` drawn, `dash_px` left out, and so on.
void draw_dashed_line(RgbImage& image, const PixelPoint& a, const PixelPoint& b, double dash_px,
                      const Pen& pen);
void fill_rectangle(RgbImage& image, int left, int top, int width, int height, const Colour& colour);

/// Writes with the built-in stroke font: Latin letters (drawn in lower case), digits and .,:-/()%+; anything
/// else leaves a space. `baseline` is the lower left corner of the first letter, `size_px` the height of a
/// digit.
void draw_text(RgbImage& image, const PixelPoint& baseline, double size_px, std::string_view text,
               const Colour& colour);
/// The same, set off from whatever lies below it.
void draw_text_with_halo(RgbImage& image, const PixelPoint& baseline, double size_px, std::string_view text,
                         const Colour& colour, const Colour& halo);
[[nodiscard]] double text_width_px(double size_px, std::string_view text);

}  // namespace swiftlet

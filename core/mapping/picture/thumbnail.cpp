// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/thumbnail.hpp"

#include <algorithm>

#include "core/base/check.hpp"

namespace swiftlet {
namespace {

/// Of the square with this corner.
Colour mean_colour(const RgbImage& image, int left, int top, int size) {
  int red = 0;
  int green = 0;
  int blue = 0;
  for (int y = top; y < top + size; ++y) {
    for (int x = left; x < left + size; ++x) {
      red += image.at(x, y).red;
      green += image.at(x, y).green;
      blue += image.at(x, y).blue;
    }
  }
  const auto mean = [pixels = size * size](int sum) { return static_cast<std::uint8_t>(sum / pixels); };
  return {mean(red), mean(green), mean(blue)};
}

}  // namespace

RgbImage thumbnail_of(const RgbImage& image, int longest_px) {
  SWIFTLET_CHECK(longest_px > 0, "a thumbnail has pixels");
  const int longest = std::max(image.width(), image.height());
  const int factor = std::min({(longest + longest_px - 1) / longest_px, image.width(), image.height()});
  RgbImage small(image.width() / factor, image.height() / factor, {});
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x)
      small.at(x, y) = mean_colour(image, x * factor, y * factor, factor);
  return small;
}

}  // namespace swiftlet

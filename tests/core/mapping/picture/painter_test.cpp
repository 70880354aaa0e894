// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/painter.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace swiftlet {
namespace {

constexpr Colour kWhite{255, 255, 255};
constexpr Colour kBlack{0, 0, 0};

long dark_pixels(const RgbImage& image) {
  return std::count_if(image.pixels().begin(), image.pixels().end(),
                       [](const Colour& c) { return c.red < 128; });
}

TEST(Painter, MixesByShare) {
  EXPECT_EQ(mix(kBlack, kWhite, 0.0), kBlack);
  EXPECT_EQ(mix(kBlack, kWhite, 1.0), kWhite);
  EXPECT_EQ(mix(kBlack, {100, 200, 50}, 0.5), (Colour{50, 100, 25}));
}

TEST(Painter, DrawsALineOfTheGivenWidth) {
  RgbImage image(20, 11, kWhite);
  draw_line(image, {4.0, 5.5}, {16.0, 5.5}, {kBlack, 3.0, 1.0});
  for (int y = 0; y < 11; ++y) EXPECT_EQ(image.at(10, y), y >= 4 && y <= 6 ? kBlack : kWhite) << y;
}

TEST(Painter, SmoothsEdgesAndBlendsByOpacity) {
  RgbImage image(20, 11, kWhite);
  draw_line(image, {4.0, 5.5}, {16.0, 5.5}, {kBlack, 2.0, 0.5});
  EXPECT_EQ(image.at(10, 5).red, 128);
  EXPECT_GT(image.at(10, 4).red, 128);
  EXPECT_LT(image.at(10, 4).red, 255);
}

TEST(Painter, CutsOffWhatReachesBeyondTheImage) {
  RgbImage image(8, 8, kWhite);
  draw_line(image, {-1e7, 4.0}, {1e7, 4.0}, {kBlack, 2.0, 1.0});
  draw_disc(image, {-50.0, -50.0}, 10.0, kBlack);
  fill_rectangle(image, 6, 6, 100, 100, kBlack);
  EXPECT_EQ(dark_pixels(image), 2 * 8 + 4);
}

TEST(Painter, DashesLeaveHalfOfTheLineOut) {
  RgbImage whole(200, 5, kWhite);
  RgbImage dashed(200, 5, kWhite);
  draw_line(whole, {0.0, 2.5}, {200.0, 2.5}, {kBlack, 1.0, 1.0});
  draw_dashed_line(dashed, {0.0, 2.5}, {200.0, 2.5}, 10.0, {kBlack, 1.0, 1.0});
  EXPECT_NEAR(static_cast<double>(dark_pixels(dashed)), 0.5 * static_cast<double>(dark_pixels(whole)), 12.0);
}

TEST(Painter, WritesWhereItSaysItDoes) {
  const double width = text_width_px(16.0, "loop closures 12");
  RgbImage image(static_cast<int>(width) + 20, 40, kWhite);
  draw_text(image, {10.0, 26.0}, 16.0, "loop closures 12", kBlack);
  EXPECT_GT(dark_pixels(image), 200);
  int leftmost = image.width();
  int rightmost = 0;
  int topmost = image.height();
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.at(x, y).red > 128) continue;
      leftmost = std::min(leftmost, x);
      rightmost = std::max(rightmost, x);
      topmost = std::min(topmost, y);
    }
  }
  EXPECT_NEAR(leftmost, 10, 2);
  EXPECT_NEAR(rightmost, 10.0 + width, 2);
  EXPECT_NEAR(topmost, 10, 2);
}

TEST(Painter, UnknownLettersAreSpaces) {
  EXPECT_DOUBLE_EQ(text_width_px(16.0, "a$b"), text_width_px(16.0, "a b"));
  EXPECT_DOUBLE_EQ(text_width_px(16.0, "AB"), text_width_px(16.0, "ab"));
  EXPECT_DOUBLE_EQ(text_width_px(16.0, ""), 0.0);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/thumbnail.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

TEST(Thumbnail, EachPixelIsTheMeanOfThoseItStandsFor) {
  RgbImage image(4, 2, {100, 0, 0});
  image.at(3, 1) = {0, 40, 200};
  const RgbImage small = thumbnail_of(image, 2);
  ASSERT_EQ(small.width(), 2);
  ASSERT_EQ(small.height(), 1);
  EXPECT_EQ(small.at(0, 0), (Colour{100, 0, 0}));
  EXPECT_EQ(small.at(1, 0), (Colour{75, 10, 50}));
}

TEST(Thumbnail, FitsItsSizeAndASmallImageStaysAsItIs) {
  const RgbImage small = thumbnail_of(RgbImage(1000, 1999, {}), 256);
  EXPECT_EQ(small.width(), 125);
  EXPECT_EQ(small.height(), 249);
  EXPECT_EQ(thumbnail_of(RgbImage(7, 256, {}), 256).height(), 256);
  EXPECT_EQ(thumbnail_of(RgbImage(2, 2000, {}), 256).width(), 1);  // too narrow for the factor
}

}  // namespace
}  // namespace swiftlet

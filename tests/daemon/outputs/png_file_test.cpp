// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/png_file.hpp"

#include <gmock/gmock.h>
#include <png.h>

#include <algorithm>
#include <vector>

namespace swiftlet {
namespace {

TEST(PngFile, GivesBackEveryPixel) {
  RgbImage image(5, 3, {1, 2, 3});
  image.at(4, 0) = {255, 0, 17};
  image.at(0, 2) = {0, 200, 100};
  const Result<std::string> bytes = encode_png(image);
  ASSERT_TRUE(bytes.ok());

  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&header, bytes->data(), bytes->size()), 0);
  header.format = PNG_FORMAT_RGB;
  EXPECT_EQ(header.width, 5U);
  EXPECT_EQ(header.height, 3U);
  std::vector<Colour> pixels(15);
  ASSERT_NE(png_image_finish_read(&header, nullptr, pixels.data(), 0, nullptr), 0);
  EXPECT_TRUE(std::equal(pixels.begin(), pixels.end(), image.pixels().begin(), image.pixels().end()));
}

TEST(PngFile, IsTheSameBytesForTheSamePicture) {
  const RgbImage image(40, 30, {9, 8, 7});
  EXPECT_EQ(encode_png(image).value(), encode_png(image).value());
}

}  // namespace
}  // namespace swiftlet

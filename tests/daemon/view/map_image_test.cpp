// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/map_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/daemon/view/view_samples.hpp"

namespace swiftlet {
namespace {

TEST(MapImage, CoversAllTilesWithUnknownBetweenThem) {
  RunHistory history;
  EXPECT_FALSE(map_image(history, std::nullopt));
  history.add_tile(1, uniform_tile({0, 0}, 1, 10), 0.5);
  history.add_tile(1, uniform_tile({2, 1}, 1, 90), 0.5);
  const auto image = map_image(history, std::nullopt);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->columns, 192U);
  EXPECT_EQ(image->occupancy_percent.size(), 192U * 128U);
  EXPECT_EQ(image->occupancy_percent.front(), 10);
  EXPECT_EQ(image->occupancy_percent.back(), 90);
  EXPECT_EQ(image->occupancy_percent[64], -1);
  EXPECT_EQ(std::ranges::count(image->occupancy_percent, 10), 4096);
}

TEST(MapImage, IsAsItWasThen) {
  RunHistory history;
  history.add_tile(5, uniform_tile({0, 0}, 1, 10), 0.5);
  EXPECT_FALSE(map_image(history, 4));
  EXPECT_TRUE(map_image(history, 5));
}

TEST(MapImage, WhatIsTooLargeIsMadeCoarser) {
  RunHistory history;
  history.add_tile(1, uniform_tile({0, 0}, 1, 10), 0.5);
  history.add_tile(1, uniform_tile({1'000'000, 1'000'000}, 1, 90), 0.5);
  const auto image = map_image(history, std::nullopt, 10'000);
  ASSERT_TRUE(image);
  EXPECT_LE(image->occupancy_percent.size(), 10'000U);
  EXPECT_EQ(image->occupancy_percent.front(), 10);
  EXPECT_EQ(image->occupancy_percent.back(), 90);
  EXPECT_GE(image->cell_m * image->columns, 0.5 * 64.0 * 1'000'001.0);
}

TEST(MapImage, Base64HasThePaddingOfItsLength) {
  const std::vector<std::int8_t> bytes{'M', 'a', 'n', -1};
  EXPECT_EQ(base64(std::span(bytes).first(0)), "");
  EXPECT_EQ(base64(std::span(bytes).first(1)), "TQ==");
  EXPECT_EQ(base64(std::span(bytes).first(2)), "TWE=");
  EXPECT_EQ(base64(std::span(bytes).first(3)), "TWFu");
  EXPECT_EQ(base64(bytes), "TWFu/w==");
}

}  // namespace
}  // namespace swiftlet

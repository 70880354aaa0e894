// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/map_legend.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace swiftlet {
namespace {

long count_of(const RgbImage& image, const Colour& colour) {
  return std::count(image.pixels().begin(), image.pixels().end(), colour);
}

TEST(MapLegend, ChoosesRoundLengthsForTheScaleBar) {
  EXPECT_DOUBLE_EQ(scale_bar_length_m(60.0, 320.0), 5.0);
  EXPECT_DOUBLE_EQ(scale_bar_length_m(20.0, 320.0), 10.0);
  EXPECT_DOUBLE_EQ(scale_bar_length_m(10.0, 320.0), 20.0);
  EXPECT_DOUBLE_EQ(scale_bar_length_m(4.0, 320.0), 50.0);
  EXPECT_DOUBLE_EQ(scale_bar_length_m(1000.0, 320.0), 1.0);
}

TEST(MapLegend, TheScaleBarIsAsLongAsItSays) {
  RgbImage image(1500, kLegendHeightPx, map_style::kUnknown);
  draw_legend(image, 0, 60.0, MapScene{});
  int last = 0;
  for (int x = 0; x < image.width(); ++x) {
    if (image.at(x, kLegendHeightPx / 2).red > 128) {
      if (last > 0) break;
      continue;
    }
    last = x;
  }
  EXPECT_NEAR(last, 24 + 5 * 60, 3);
}

TEST(MapLegend, FillsItsStripAndNothingElse) {
  RgbImage image(900, 40 + kLegendHeightPx, map_style::kUnknown);
  draw_legend(image, 40, 60.0, MapScene{});
  EXPECT_EQ(image.at(5, 39), map_style::kUnknown);
  EXPECT_EQ(image.at(5, 40), map_style::kPaper);
}

TEST(MapLegend, FitsOnANarrowPicture) {
  RgbImage image(60, kLegendHeightPx, map_style::kUnknown);
  MapScene scene;
  scene.closures.resize(3);
  draw_legend(image, 0, 60.0, scene);
  EXPECT_EQ(count_of(image, map_style::kUnknown), 0);
}

TEST(MapLegend, ExplainsOnlyWhatIsThere) {
  RgbImage bare(1500, kLegendHeightPx, map_style::kUnknown);
  RgbImage full(1500, kLegendHeightPx, map_style::kUnknown);
  MapScene scene;
  draw_legend(bare, 0, 60.0, scene);
  scene.walls.resize(1);
  scene.closures.resize(2);
  scene.dropped_closures.resize(1);
  draw_legend(full, 0, 60.0, scene);
  EXPECT_LT(count_of(full, map_style::kPaper), count_of(bare, map_style::kPaper) - 500);
}

}  // namespace
}  // namespace swiftlet

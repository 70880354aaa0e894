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

TEST(MapLegend, TheTitleNamesRunDateAndLength) {
  MapScene scene;
  scene.title = "olsson.pcap";
  EXPECT_EQ(title_text(scene), "olsson.pcap");
  scene.began = HostTime(std::chrono::seconds(1'600'000'000));
  scene.duration = std::chrono::seconds(83);
  scene.length_m = 5.2;
  scene.scans.resize(1);
  EXPECT_EQ(title_text(scene), "olsson.pcap   2020-09-13 12:26 utc, 1:23 min, 5 m");
  scene.title.clear();
  EXPECT_EQ(title_text(scene), "2020-09-13 12:26 utc, 1:23 min, 5 m");
}

TEST(MapLegend, AxesStandAtTheMetresThatTheySay) {
  MapScene scene;
  scene.scans = {{{-3.0, -1.0}, {-3.0, -1.0}, true}, {{7.0, 4.0}, {7.0, 4.0}, true}};
  const MapView view(scene);
  RgbImage image(view.width_px(), view.height_px(), map_style::kPaper);
  draw_axes(image, view);
  const auto is_inked = [&](const PixelPoint& at, int x, int y) {
    return image.at(static_cast<int>(at.x) + x, static_cast<int>(at.y) + y).red < 200;
  };
  const int last_row = view.height_px() - 2;
  EXPECT_TRUE(is_inked({view.pixel({0.0, 0.0}).x, 0.0}, 0, last_row));
  EXPECT_TRUE(is_inked({0.0, view.pixel({0.0, 0.0}).y}, 2, 0));
  EXPECT_FALSE(is_inked({view.pixel({0.37, 0.0}).x, 0.0}, 0, 5));
}

TEST(MapLegend, TheNarrowestMapHasRoomForTheKeyOfClosures) {
  MapScene scene;
  scene.scans.resize(2);
  scene.duration = std::chrono::minutes(12);
  scene.walls.resize(1);
  for (const double px_per_m : {10.0, 20.0, 60.0, 160.0}) {
    RgbImage without(kMinWidthPx, kLegendHeightPx, map_style::kUnknown);
    RgbImage with = without;
    draw_legend(without, 0, px_per_m, scene);
    MapScene closed = scene;
    closed.closures.resize(12);
    draw_legend(with, 0, px_per_m, closed);
    EXPECT_LT(count_of(with, map_style::kPaper), count_of(without, map_style::kPaper)) << px_per_m;
  }
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

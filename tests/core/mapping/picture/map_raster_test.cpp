// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/map_raster.hpp"

#include <gmock/gmock.h>

#include "core/mapping/picture/map_legend.hpp"
#include "core/mapping/picture/map_style.hpp"
#include "core/mapping/picture/map_view.hpp"

namespace swiftlet {
namespace {

/// A tile at the origin, free all over, with a wall along its top row.
MapScene small_scene() {
  MapScene scene;
  MapTile tile;
  tile.occupancy_percent.fill(3);
  for (int x = 0; x < kTileCells; ++x)
    tile.occupancy_percent[kCellsInTile - kTileCells + static_cast<std::size_t>(x)] = 98;
  scene.tiles.push_back(tile);
  for (int i = 0; i <= 20; ++i) {
    const Point2 p{0.5 + 0.1 * i, 1.0};
    scene.scans.push_back(
        {p, {p.x_m, p.y_m + 0.3}, i == 0, scene.began + i * std::chrono::milliseconds(100)});
  }
  scene.duration = std::chrono::seconds(2);
  return scene;
}

Colour colour_at(const MapScene& scene, const RgbImage& image, const Point2& p_map) {
  const PixelPoint pixel = MapView(scene).pixel(p_map);
  return image.at(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
}

TEST(MapRaster, ShowsFreeWallAndUnknownApart) {
  const MapScene scene = small_scene();
  const RgbImage image = draw_map(scene);
  EXPECT_EQ(colour_at(scene, image, {1.52, 2.52}), map_style::kPaper);
  EXPECT_EQ(colour_at(scene, image, {1.52, 3.17}), map_style::kInk);
  EXPECT_EQ(colour_at(scene, image, {1.52, 3.42}), map_style::kUnknown);
  EXPECT_EQ(image.height(), MapView(scene).height_px() + kLegendHeightPx + kTitleHeightPx);
}

TEST(MapRaster, ColoursThePathByTime) {
  const MapScene scene = small_scene();
  const RgbImage image = draw_map(scene);
  EXPECT_EQ(colour_at(scene, image, {0.5, 1.0}), map_style::time_colour(0.0));
  EXPECT_EQ(colour_at(scene, image, {2.5, 1.0}), map_style::time_colour(1.0));
  const Colour middle = colour_at(scene, image, {1.5, 1.0});
  EXPECT_NEAR(middle.red, map_style::time_colour(0.5).red, 20);
  EXPECT_NEAR(middle.blue, map_style::time_colour(0.5).blue, 20);
}

TEST(MapRaster, ColoursAStoreyByTheTimeOfTheWholeRun) {
  MapScene scene = small_scene();
  scene.began -= std::chrono::seconds(2);
  scene.duration = std::chrono::seconds(8);
  const RgbImage image = draw_map(scene);
  EXPECT_EQ(colour_at(scene, image, {0.5, 1.0}), map_style::time_colour(0.25));
  EXPECT_EQ(colour_at(scene, image, {2.5, 1.0}), map_style::time_colour(0.5));
}

TEST(MapRaster, ASilenceTakesItsTime) {
  MapScene scene = small_scene();
  for (std::size_t i = 11; i < scene.scans.size(); ++i) scene.scans[i].stamp += std::chrono::seconds(8);
  scene.duration += std::chrono::seconds(8);
  const Colour middle = colour_at(scene, draw_map(scene), {1.45, 1.0});
  EXPECT_NEAR(middle.red, map_style::time_colour(0.1).red, 10);
  EXPECT_NEAR(middle.blue, map_style::time_colour(0.1).blue, 10);
}

TEST(MapRaster, DoesNotJoinPathsAcrossABreak) {
  MapScene scene = small_scene();
  scene.scans[10].starts_segment = true;
  EXPECT_EQ(colour_at(scene, draw_map(scene), {1.45, 1.0}), map_style::kPaper);
}

TEST(MapRaster, DrawsClosuresAndWalls) {
  MapScene scene = small_scene();
  const RgbImage plain = draw_map(scene);
  scene.closures.push_back({{0.5, 2.0}, {2.5, 2.0}});
  scene.walls.push_back({{0.5, 0.3}, {2.5, 0.3}});
  const RgbImage image = draw_map(scene);
  const Colour closure = colour_at(scene, image, {1.5, 2.0});
  EXPECT_GT(closure.green, closure.red + 20);
  const Colour wall = colour_at(scene, image, {1.5, 0.3});
  EXPECT_GT(wall.blue, wall.red + 50);
  EXPECT_EQ(colour_at(scene, plain, {1.5, 2.0}), map_style::kPaper);
}

TEST(MapRaster, KeepsThinWallsVisibleAtSmallScales) {
  MapScene scene = small_scene();
  scene.scans = {{{400.0, 300.0}, {400.0, 300.0}, true}, {{-400.0, -300.0}, {-400.0, -300.0}, true}};
  const RgbImage image = draw_map(scene);
  EXPECT_EQ(colour_at(scene, image, {1.52, 3.17}), map_style::kInk);
}

TEST(MapRaster, GivesTheSamePictureForTheSameScene) {
  const RgbImage a = draw_map(small_scene());
  const RgbImage b = draw_map(small_scene());
  EXPECT_TRUE(std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin(), b.pixels().end()));
}

TEST(MapRaster, APlanHasTheWallsAlone) {
  MapScene scene = small_scene();
  scene.closures.push_back({{0.5, 2.0}, {2.5, 2.0}});
  scene.walls.push_back({{0.5, 0.3}, {2.5, 0.3}});
  const RgbImage plan = draw_plan(scene);
  EXPECT_GT(colour_at(scene, plan, {1.5, 0.3}).blue, colour_at(scene, plan, {1.5, 0.3}).red + 50);
  EXPECT_EQ(colour_at(scene, plan, {1.5, 2.0}), map_style::kPaper);
  EXPECT_EQ(colour_at(scene, plan, {1.5, 1.0}), map_style::kPaper);
  EXPECT_EQ(colour_at(scene, plan, {1.52, 3.17}), map_style::kPaper);
  EXPECT_EQ(plan.width(), draw_map(scene).width());
  EXPECT_EQ(plan.height(), draw_map(scene).height());
}

TEST(MapRaster, SaysWhereOdometryIsCutOff) {
  const MapScene whole = small_scene();
  MapScene strays = small_scene();
  strays.scans.back().odometry_map = {50.0, 1.0};
  EXPECT_TRUE(MapView(whole).shows(whole.scans.back().odometry_map));
  EXPECT_FALSE(MapView(strays).shows(strays.scans.back().odometry_map));
  const RgbImage cut = draw_map(strays);
  const int title_px = MapView(strays).height_px() + kLegendHeightPx;
  for (const bool cuts_odometry : {true, false}) {
    RgbImage again = cut;
    draw_title(again, title_px, strays, cuts_odometry);
    EXPECT_EQ(std::equal(cut.pixels().begin(), cut.pixels().end(), again.pixels().begin()), cuts_odometry);
  }
}

TEST(MapRaster, DrawsARunOfNothing) {
  const RgbImage image = draw_map(MapScene{});
  EXPECT_GT(image.width(), 0);
}

}  // namespace
}  // namespace swiftlet

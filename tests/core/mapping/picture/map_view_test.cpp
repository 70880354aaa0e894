// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/map_view.hpp"

#include <gmock/gmock.h>

namespace swiftlet {
namespace {

MapScene scene_between(const Point2& low, const Point2& high) {
  MapScene scene;
  for (const Point2& p : {low, high}) scene.scans.push_back({p, p, false});
  return scene;
}

TEST(MapView, KeepsTheLongerSideReadableForAnyExtent) {
  for (const double extent_m : {12.0, 25.0, 47.0, 80.0, 130.0, 400.0, 3000.0}) {
    const MapView view(scene_between({-3.0, 2.0}, {-3.0 + extent_m, 2.0 + extent_m / 2.0}));
    EXPECT_GE(view.width_px(), 950) << extent_m;
    EXPECT_LE(view.width_px(), 2000) << extent_m;
    EXPECT_LT(view.height_px(), view.width_px()) << extent_m;
  }
}

TEST(MapView, PutsLargerYHigher) {
  const MapView view(scene_between({0.0, 0.0}, {10.0, 10.0}));
  const PixelPoint low = view.pixel({1.0, 1.0});
  const PixelPoint high = view.pixel({2.0, 9.0});
  EXPECT_LT(low.x, high.x);
  EXPECT_GT(low.y, high.y);
  EXPECT_NEAR(high.x - low.x, view.px_per_m(), 1e-9);
  EXPECT_NEAR(low.y - high.y, 8.0 * view.px_per_m(), 1e-9);
}

TEST(MapView, CellsLieWherePointsDo) {
  for (const double extent_m : {10.0, 300.0}) {
    const MapView view(scene_between({-extent_m, -extent_m}, {extent_m, extent_m}));
    for (const CellIndex cell : {CellIndex{0, 0}, CellIndex{-7, 12}, CellIndex{55, -31}}) {
      const PixelPoint centre = view.pixel({(cell.x + 0.5) * 0.05, (cell.y + 0.5) * 0.05});
      const PixelRectangle r = view.cell_rectangle(cell);
      EXPECT_GE(centre.x, r.left);
      EXPECT_LE(centre.x, r.left + r.size);
      EXPECT_GE(centre.y, r.top);
      EXPECT_LE(centre.y, r.top + r.size);
    }
  }
}

TEST(MapView, OdometryThatStraysDoesNotShrinkTheMap) {
  MapScene scene = scene_between({0.0, 0.0}, {12.0, 12.0});
  scene.scans.push_back({{6.0, 6.0}, {500.0, -500.0}, false});
  const MapView view(scene);
  EXPECT_LT(view.width_px() / view.px_per_m(), 12.0 * (1.0 + 1.0 / 6.0) + 1.5);
}

TEST(MapView, ANarrowSceneStandsInTheMiddleOfAReadableWidth) {
  for (const double length_m : {1.0, 20.0, 60.0, 400.0}) {
    const MapView view(scene_between({-1.0, 0.0}, {1.0, length_m}));
    EXPECT_GE(view.width_px(), kMinWidthPx) << length_m;
    EXPECT_LT(view.width_px(), kMinWidthPx + 10) << length_m;
    EXPECT_NEAR(view.pixel({0.0, 0.0}).x, view.width_px() / 2.0, 10.0) << length_m;
  }
}

TEST(MapView, ShowsSomethingOfAnEmptyScene) {
  const MapView view{MapScene{}};
  EXPECT_GT(view.width_px(), 0);
  EXPECT_GT(view.height_px(), 0);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/map_raster.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/mapping/picture/map_legend.hpp"
#include "core/mapping/picture/map_style.hpp"
#include "core/mapping/picture/map_view.hpp"

namespace swiftlet {

namespace {

constexpr double kDashLengthPx = 6.0;

/// Unknown cells are passed by; of several cells in one pixel the most occupied one shows, so that walls stay
/// visible however small the scale.
void draw_tile(RgbImage& image, const MapTile& tile, const MapView& view, std::vector<std::int8_t>& shown) {
  for (int row = 0; row < kTileCells; ++row) {
    for (int column = 0; column < kTileCells; ++column) {
      const std::int8_t percent = tile.occupancy_percent[static_cast<std::size_t>(row) * kTileCells +
                                                         static_cast<std::size_t>(column)];
      if (percent < 0) continue;
      const PixelRectangle r =
          view.cell_rectangle({tile.index.x * kTileCells + column, tile.index.y * kTileCells + row});
      for (int y = std::max(r.top, 0); y < std::min(r.top + r.size, image.height()); ++y) {
        for (int x = std::max(r.left, 0); x < std::min(r.left + r.size, image.width()); ++x) {
          std::int8_t& most = shown[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width()) +
                                    static_cast<std::size_t>(x)];
          if (percent <= most) continue;
          most = percent;
          image.at(x, y) = map_style::occupancy_colour(percent);
        }
      }
    }
  }
}

void draw_grid(RgbImage& image, const MapScene& scene, const MapView& view) {
  std::vector<std::int8_t> shown(image.pixels().size(), -1);
  for (const MapTile& tile : scene.tiles) draw_tile(image, tile, view, shown);
}

void draw_odometry(RgbImage& image, const MapScene& scene, const MapView& view) {
  for (std::size_t i = 1; i < scene.scans.size(); ++i) {
    if (scene.scans[i].starts_segment) continue;
    draw_line(image, view.pixel(scene.scans[i - 1].odometry_map), view.pixel(scene.scans[i].odometry_map),
              map_style::kOdometry);
  }
}

/// Of the whole run's time, as the legend has it.
Colour colour_at_time_of(const ScenePoint& scan, const MapScene& scene) {
  if (scene.duration <= Duration::zero()) return map_style::time_colour(0.0);
  return map_style::time_colour(to_seconds(scan.stamp - scene.began) / to_seconds(scene.duration));
}

void draw_path(RgbImage& image, const MapScene& scene, const MapView& view) {
  for (std::size_t i = 1; i < scene.scans.size(); ++i) {
    if (scene.scans[i].starts_segment) continue;
    draw_line(image, view.pixel(scene.scans[i - 1].corrected_map), view.pixel(scene.scans[i].corrected_map),
              {colour_at_time_of(scene.scans[i], scene), map_style::kPathWidthPx, 1.0});
  }
}

void draw_walls(RgbImage& image, const MapScene& scene, const MapView& view) {
  for (const MapSegment& wall : scene.walls)
    draw_line(image, view.pixel(wall.start_map), view.pixel(wall.end_map), map_style::kWall);
}

void draw_closures(RgbImage& image, const MapScene& scene, const MapView& view) {
  for (const MapSegment& closure : scene.closures)
    draw_line(image, view.pixel(closure.start_map), view.pixel(closure.end_map), map_style::kClosure);
  for (const MapSegment& closure : scene.dropped_closures)
    draw_dashed_line(image, view.pixel(closure.start_map), view.pixel(closure.end_map), kDashLengthPx,
                     map_style::kDropped);
}

void draw_mark(RgbImage& image, const PixelPoint& centre, double radius_px, const Colour& colour) {
  draw_disc(image, centre, radius_px + 2.0, map_style::kPaper);
  draw_disc(image, centre, radius_px, colour);
}

/// Named to either side, the end on a smaller disc: both can be read where a run ends at its start.
void draw_marks(RgbImage& image, const MapScene& scene, const MapView& view) {
  constexpr double kPlaceTextPx = 14.0;
  constexpr double kToText = 1.5 * map_style::kStartRadiusPx;
  const ScenePoint& first = scene.scans.front();
  const ScenePoint& last = scene.scans.back();
  const PixelPoint start = view.pixel(first.corrected_map);
  const PixelPoint end = view.pixel(last.corrected_map);
  draw_mark(image, start, map_style::kStartRadiusPx, colour_at_time_of(first, scene));
  draw_mark(image, end, map_style::kEndRadiusPx, colour_at_time_of(last, scene));
  draw_text_with_halo(image, {start.x + kToText, start.y + kPlaceTextPx / 2.0}, kPlaceTextPx, "start",
                      map_style::kInk, map_style::kPaper);
  draw_text_with_halo(image,
                      {end.x - kToText - text_width_px(kPlaceTextPx, "end"), end.y + kPlaceTextPx / 2.0},
                      kPlaceTextPx, "end", map_style::kInk, map_style::kPaper);
}

}  // namespace

RgbImage draw_map(const MapScene& scene) {
  const MapView view(scene);
  RgbImage image(view.width_px(), view.height_px() + kLegendHeightPx + kTitleHeightPx, map_style::kUnknown);
  draw_grid(image, scene, view);
  draw_odometry(image, scene, view);
  draw_walls(image, scene, view);
  draw_closures(image, scene, view);
  draw_path(image, scene, view);
  if (!scene.scans.empty()) draw_marks(image, scene, view);
  draw_axes(image, view);
  const bool cuts_odometry =
      !std::all_of(scene.scans.begin(), scene.scans.end(),
                   [&](const ScenePoint& scan) { return view.shows(scan.odometry_map); });
  draw_legend(image, view.height_px(), view.px_per_m(), scene);
  draw_title(image, view.height_px() + kLegendHeightPx, scene, cuts_odometry);
  return image;
}

RgbImage draw_plan(const MapScene& scene) {
  const MapView view(scene);
  RgbImage image(view.width_px(), view.height_px() + kLegendHeightPx + kTitleHeightPx, map_style::kPaper);
  draw_walls(image, scene, view);
  draw_axes(image, view);
  MapScene key;
  key.walls = scene.walls;
  draw_legend(image, view.height_px(), view.px_per_m(), key);
  draw_title(image, view.height_px() + kLegendHeightPx, scene, false);
  return image;
}

}  // namespace swiftlet

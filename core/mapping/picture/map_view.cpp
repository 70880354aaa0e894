// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/map_view.hpp"

#include <algorithm>
#include <limits>

namespace swiftlet {

namespace {

constexpr int kMaxSidePx = 1900;
constexpr int kMaxPxInCell = 8;
constexpr double kMarginM = 0.6;
constexpr double kOdometryShare = 1.0 / 6.0;

/// A rectangle in the map frame.
struct Extent {
  Point2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void include(const Point2& p) {
    low = {std::min(low.x_m, p.x_m), std::min(low.y_m, p.y_m)};
    high = {std::max(high.x_m, p.x_m), std::max(high.y_m, p.y_m)};
  }
  [[nodiscard]] bool empty() const { return !(low.x_m <= high.x_m && low.y_m <= high.y_m); }
};

void include_known_cells(Extent& extent, const MapTile& tile, double resolution_m) {
  for (int row = 0; row < kTileCells; ++row) {
    for (int column = 0; column < kTileCells; ++column) {
      const int i = row * kTileCells + column;
      if (tile.occupancy_percent[static_cast<std::size_t>(i)] < 0) continue;
      const Point2 corner{(tile.index.x * kTileCells + column) * resolution_m,
                          (tile.index.y * kTileCells + row) * resolution_m};
      extent.include(corner);
      extent.include({corner.x_m + resolution_m, corner.y_m + resolution_m});
    }
  }
}

Extent extent_of(const MapScene& scene) {
  Extent extent;
  for (const MapTile& tile : scene.tiles) include_known_cells(extent, tile, scene.resolution_m);
  for (const ScenePoint& scan : scene.scans) extent.include(scan.corrected_map);
  if (extent.empty()) extent.include({0.0, 0.0});
  const Extent known = extent;
  const double spare_x = (known.high.x_m - known.low.x_m) * kOdometryShare;
  const double spare_y = (known.high.y_m - known.low.y_m) * kOdometryShare;
  for (const ScenePoint& scan : scene.scans) {
    const Point2& p = scan.odometry_map;
    extent.include({std::clamp(p.x_m, known.low.x_m - spare_x, known.high.x_m + spare_x),
                    std::clamp(p.y_m, known.low.y_m - spare_y, known.high.y_m + spare_y)});
  }
  extent.include({extent.low.x_m - kMarginM, extent.low.y_m - kMarginM});
  extent.include({extent.high.x_m + kMarginM, extent.high.y_m + kMarginM});
  return extent;
}

/// Evenly to both sides, where they are fewer.
void widen(CellIndex& low, CellIndex& high, int columns) {
  const int missing = std::max(columns - (high.x - low.x + 1), 0);
  low.x -= missing / 2;
  high.x += missing - missing / 2;
}

int round_down(int value, int step) {
  return (value >= 0 ? value / step : -((-value + step - 1) / step)) * step;
}

}  // namespace

MapView::MapView(const MapScene& scene) : resolution_m_(scene.resolution_m) {
  const Extent extent = extent_of(scene);
  CellIndex low = cell_of(extent.low, resolution_m_);
  CellIndex high = cell_of(extent.high, resolution_m_);
  const int longest_cells = std::max(high.x - low.x, high.y - low.y) + 1;
  px_in_cell_ = std::clamp(kMaxSidePx / longest_cells, 1, kMaxPxInCell);
  cells_in_px_ = (longest_cells + kMaxSidePx - 1) / kMaxSidePx;
  px_per_cell_ = static_cast<double>(px_in_cell_) / cells_in_px_;
  widen(low, high, (kMinWidthPx * cells_in_px_ + px_in_cell_ - 1) / px_in_cell_);
  first_ = {round_down(low.x, cells_in_px_), round_down(low.y, cells_in_px_)};
  width_px_ = ((high.x - first_.x) / cells_in_px_ + 1) * px_in_cell_;
  height_px_ = ((high.y - first_.y) / cells_in_px_ + 1) * px_in_cell_;
}

bool MapView::shows(const Point2& p_map) const {
  const PixelPoint at = pixel(p_map);
  return at.x >= 0.0 && at.y >= 0.0 && at.x <= width_px_ && at.y <= height_px_;
}

PixelPoint MapView::pixel(const Point2& p_map) const {
  return {(p_map.x_m / resolution_m_ - first_.x) * px_per_cell_,
          height_px_ - (p_map.y_m / resolution_m_ - first_.y) * px_per_cell_};
}

PixelRectangle MapView::cell_rectangle(CellIndex cell) const {
  const int column = (cell.x - first_.x) / cells_in_px_;
  const int row = (cell.y - first_.y) / cells_in_px_;
  return {column * px_in_cell_, height_px_ - (row + 1) * px_in_cell_, px_in_cell_};
}

}  // namespace swiftlet

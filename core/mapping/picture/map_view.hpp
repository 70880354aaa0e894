// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/geometry/grid.hpp"
#include "core/mapping/picture/map_scene.hpp"
#include "core/mapping/picture/painter.hpp"

namespace swiftlet {

struct PixelRectangle {
  int left = 0;
  int top = 0;
  int size = 0;
};

/// Title and legend need it.
inline constexpr int kMinWidthPx = 1060;

/// Which part of the map a picture shows and how large. A cell is a whole number of pixels, or a pixel a
/// whole number of cells, so that walls are sharp everywhere.
class MapView {
 public:
  /// Frames the whole scene; odometry may add a sixth of that on each side, what strays farther is cut off.
  /// A narrow scene stands in the middle of kMinWidthPx.
  explicit MapView(const MapScene& scene);

  [[nodiscard]] int width_px() const { return width_px_; }
  [[nodiscard]] int height_px() const { return height_px_; }
  [[nodiscard]] double px_per_m() const { return px_per_cell_ / resolution_m_; }
  [[nodiscard]] bool shows(const Point2& p_map) const;
  [[nodiscard]] PixelPoint pixel(const Point2& p_map) const;
  /// The pixels of a cell; where a pixel holds several cells, that pixel.
  [[nodiscard]] PixelRectangle cell_rectangle(CellIndex cell) const;

 private:
  double resolution_m_;
  int px_in_cell_ = 1;  ///< one of these two is 1
  int cells_in_px_ = 1;
  double px_per_cell_ = 1.0;
  CellIndex first_;  ///< lowest cell shown, aligned to a pixel
  int width_px_ = 0;
  int height_px_ = 0;
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/backend/loop_closing/submap.hpp"

namespace swiftlet {

/// A submap straight from a picture, without a flight: '#' occupied, '.' free, ' ' unknown, one character a
/// cell. It stands as one reads it: x to the right, y up; the origin of its frame lies in the middle of the
/// picture.
inline Submap drawn_submap(const std::vector<std::string>& picture, double resolution_m, int kernel_cells) {
  GridGeometry geometry;
  geometry.resolution_m = resolution_m;
  geometry.width = static_cast<int>(picture[0].size());
  geometry.height = static_cast<int>(picture.size());
  geometry.origin_m = {-0.5 * geometry.width * resolution_m, -0.5 * geometry.height * resolution_m};
  std::vector<std::uint8_t> cells;
  for (auto line = picture.rbegin(); line != picture.rend(); ++line) {
    for (const char c : *line)
      cells.push_back(c == '#' ? std::uint8_t{240} : c == '.' ? std::uint8_t{20} : std::uint8_t{0});
  }
  const Point2 high{-geometry.origin_m.x_m, -geometry.origin_m.y_m};
  return Submap{.reference = {},
                .scans = {},
                .end_path_m = 0.0,
                .geometry = geometry,
                .cells = max_kernel(geometry, cells, kernel_cells),
                .low_m = geometry.origin_m,
                .high_m = high};
}

}  // namespace swiftlet

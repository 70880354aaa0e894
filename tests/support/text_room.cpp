// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/text_room.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"

namespace swiftlet {

TextRoom::TextRoom(const std::vector<std::string>& picture, double cell_m, const Point2& origin_m)
    : picture_(picture), cell_m_(cell_m), origin_m_(origin_m) {
  for (std::size_t line = 0; line < picture_.size(); ++line) {
    for (std::size_t column = 0; column < picture_[line].size(); ++column) {
      if (picture_[line][column] == '#') walls_.push_back(corner(column, line));
    }
  }
}

Point2 TextRoom::corner(std::size_t column, std::size_t line) const {
  return {origin_m_.x_m + static_cast<double>(column) * cell_m_,
          origin_m_.y_m + static_cast<double>(picture_.size() - 1 - line) * cell_m_};
}

Point2 TextRoom::place(char letter) const {
  for (std::size_t line = 0; line < picture_.size(); ++line) {
    const std::size_t column = picture_[line].find(letter);
    if (column == std::string::npos) continue;
    const Point2 low = corner(column, line);
    return {low.x_m + 0.5 * cell_m_, low.y_m + 0.5 * cell_m_};
  }
  SWIFTLET_CHECK(false, "the place is drawn in the picture");
}

std::optional<double> TextRoom::range_m(const Point2& from, double bearing_rad, double max_range_m) const {
  const double direction[2] = {std::cos(bearing_rad), std::sin(bearing_rad)};
  std::optional<double> nearest_m;
  for (const Point2& wall : walls_) {
    // Where the ray is between the block's sides in x and in y at once.
    const double low[2] = {wall.x_m - from.x_m, wall.y_m - from.y_m};
    double enters_m = 0.0;
    double leaves_m = max_range_m;
    for (int axis = 0; axis < 2; ++axis) {
      const double a = low[axis] / direction[axis];
      const double b = (low[axis] + cell_m_) / direction[axis];
      enters_m = std::max(enters_m, std::min(a, b));
      leaves_m = std::min(leaves_m, std::max(a, b));
    }
    if (enters_m < leaves_m && (!nearest_m || enters_m < *nearest_m)) nearest_m = enters_m;
  }
  return nearest_m;
}

}  // namespace swiftlet

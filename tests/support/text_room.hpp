// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// A room drawn as text: '#' is a block of wall, everything else is free, letters name places. The picture
/// stands as one reads it: x to the right, y up, the lower left corner at `origin_m`.
class TextRoom {
 public:
  TextRoom(const std::vector<std::string>& picture, double cell_m, const Point2& origin_m = {});

  /// The middle of the cell that bears this letter. Precondition: it is drawn.
  [[nodiscard]] Point2 place(char letter) const;
  /// Distance to the first wall, exact; nothing within `max_range_m` gives nothing.
  [[nodiscard]] std::optional<double> range_m(const Point2& from, double bearing_rad,
                                              double max_range_m) const;

 private:
  [[nodiscard]] Point2 corner(std::size_t column, std::size_t line) const;

  std::vector<std::string> picture_;
  double cell_m_;
  Point2 origin_m_;
  std::vector<Point2> walls_;  // lower left corners of the blocks
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <cmath>

namespace swiftlet {

struct Point2 {
  double x_m = 0.0;
  double y_m = 0.0;
};

[[nodiscard]] inline double distance_m(const Point2& a, const Point2& b) {
  return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
}
/// From a to b, counter-clockwise from x.
[[nodiscard]] inline double bearing_rad(const Point2& a, const Point2& b) {
  return std::atan2(b.y_m - a.y_m, b.x_m - a.x_m);
}
/// From p to the nearest point of the segment, whose length is not 0.
[[nodiscard]] inline double distance_to_segment_m(const Point2& p, const Point2& start, const Point2& end) {
  const Point2 along{end.x_m - start.x_m, end.y_m - start.y_m};
  const Point2 to{p.x_m - start.x_m, p.y_m - start.y_m};
  const double squared = along.x_m * along.x_m + along.y_m * along.y_m;
  const double share = std::clamp((to.x_m * along.x_m + to.y_m * along.y_m) / squared, 0.0, 1.0);
  return std::hypot(to.x_m - share * along.x_m, to.y_m - share * along.y_m);
}

}  // namespace swiftlet

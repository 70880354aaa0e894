// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/nearest_wall.hpp"

#include <algorithm>

#include "core/backend/refinement/wall_map.hpp"

namespace swiftlet {

std::optional<Point2> nearest_wall_normal(std::span<const Point2> returns, const Point2& place) {
  if (returns.empty()) return std::nullopt;
  const Point2 nearest = *std::min_element(
      returns.begin(), returns.end(),
      [&](const Point2& a, const Point2& b) { return distance_m(a, place) < distance_m(b, place); });
  const WallFitTuning tuning;
  Moments2 moments;
  for (const Point2& p : returns)
    if (distance_m(p, nearest) <= tuning.radius_m) moments.add({p.x_m - nearest.x_m, p.y_m - nearest.y_m});
  const std::optional<LocalWall> wall = wall_through(moments, nearest, tuning);
  return wall ? std::optional(wall->normal_map) : std::nullopt;
}

}  // namespace swiftlet

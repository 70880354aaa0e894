// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/wall_support.hpp"

#include <cmath>

namespace swiftlet {

namespace {

constexpr double kReachM = 0.1;
constexpr double kBridgeM = 0.4;
constexpr double kLeastM = 0.4;

bool occupied_near(const Point2& p_map, double resolution_m,
                   const std::function<bool(CellIndex)>& is_occupied) {
  const CellIndex centre = cell_of({p_map.x_m / resolution_m, p_map.y_m / resolution_m});
  const int reach = static_cast<int>(std::lround(kReachM / resolution_m));
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (is_occupied({centre.x + dx, centre.y + dy})) return true;
  return false;
}

}  // namespace

std::vector<MapSegment> supported_parts(const MapSegment& wall, double resolution_m,
                                        const std::function<bool(CellIndex)>& is_occupied) {
  const double dx = wall.end_map.x_m - wall.start_map.x_m;
  const double dy = wall.end_map.y_m - wall.start_map.y_m;
  const double length_m = std::hypot(dx, dy);
  const int steps = static_cast<int>(std::ceil(length_m / resolution_m));
  const auto point_at = [&](int step) {
    const double share = static_cast<double>(step) / steps;
    return Point2{wall.start_map.x_m + dx * share, wall.start_map.y_m + dy * share};
  };
  std::vector<MapSegment> parts;
  int first = 0;    // of the part being followed
  int newest = -1;  // its last supported step; -1 while there is none
  const auto finish = [&] {
    if (newest >= 0 && (newest - first) * length_m >= kLeastM * steps)
      parts.push_back({point_at(first), point_at(newest)});
    newest = -1;
  };
  for (int step = 0; steps > 0 && step <= steps; ++step) {
    if (!occupied_near(point_at(step), resolution_m, is_occupied)) continue;
    if (newest >= 0 && (step - newest) * length_m > kBridgeM * steps) finish();
    if (newest < 0) first = step;
    newest = step;
  }
  finish();
  return parts;
}

}  // namespace swiftlet

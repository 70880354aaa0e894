// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/wall_support.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "core/geometry/moments2.hpp"

namespace swiftlet {

namespace {

bool occupied_near(const Point2& p_map, double resolution_m, double reach_m,
                   const std::function<bool(CellIndex)>& is_occupied) {
  const CellIndex centre = cell_of(p_map, resolution_m);
  const int reach = static_cast<int>(std::lround(reach_m / resolution_m));
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (is_occupied({centre.x + dx, centre.y + dy})) return true;
  return false;
}

/// The centres of the occupied cells around a wall, found along its normals.
std::vector<Point2> cells_around(const MapSegment& wall, double reach_m, double resolution_m,
                                 const std::function<bool(CellIndex)>& is_occupied) {
  const double dx = wall.end_map.x_m - wall.start_map.x_m;
  const double dy = wall.end_map.y_m - wall.start_map.y_m;
  const double length_m = std::hypot(dx, dy);
  std::set<std::pair<int, int>> cells;
  const int reach = static_cast<int>(std::lround(reach_m / resolution_m));
  for (double along_m = 0.0; length_m > 0.0 && along_m <= length_m; along_m += resolution_m) {
    for (int across = -reach; across <= reach; ++across) {
      const double x_m = wall.start_map.x_m + (along_m * dx - across * resolution_m * dy) / length_m;
      const double y_m = wall.start_map.y_m + (along_m * dy + across * resolution_m * dx) / length_m;
      const CellIndex cell = cell_of({x_m, y_m}, resolution_m);
      if (is_occupied(cell)) cells.insert({cell.x, cell.y});
    }
  }
  std::vector<Point2> centres;
  centres.reserve(cells.size());
  for (const auto& [x, y] : cells) centres.push_back({(x + 0.5) * resolution_m, (y + 0.5) * resolution_m});
  return centres;
}

/// The wall's ends, carried onto the line through the points along their main axis.
MapSegment onto_line_through(const std::vector<Point2>& points, const MapSegment& wall) {
  Moments2 moments;  // from the wall's start: small numbers keep their digits
  for (const Point2& p : points) moments.add({p.x_m - wall.start_map.x_m, p.y_m - wall.start_map.y_m});
  const Scatter2 scatter = moments.scatter();
  const Point2 normal = scatter.normal();
  const auto project = [&](const Point2& p) {
    const double across_m = (p.x_m - wall.start_map.x_m - scatter.mean.x_m) * normal.x_m +
                            (p.y_m - wall.start_map.y_m - scatter.mean.y_m) * normal.y_m;
    return Point2{p.x_m - across_m * normal.x_m, p.y_m - across_m * normal.y_m};
  };
  return {project(wall.start_map), project(wall.end_map)};
}

double cos_between(const MapSegment& a, const MapSegment& b) {
  const double ax = a.end_map.x_m - a.start_map.x_m;
  const double ay = a.end_map.y_m - a.start_map.y_m;
  const double bx = b.end_map.x_m - b.start_map.x_m;
  const double by = b.end_map.y_m - b.start_map.y_m;
  return (ax * bx + ay * by) / (std::hypot(ax, ay) * std::hypot(bx, by));
}

}  // namespace

MapSegment fitted_to_grid(const MapSegment& wall, double resolution_m,
                          const std::function<bool(CellIndex)>& is_occupied,
                          const WallSupportTuning& tuning) {
  MapSegment fitted = wall;
  const double min_cosine = std::cos(0.5 * tuning.same_wall_rad);  // beyond, the fit found something else
  for (const double reach_m :
       {tuning.same_wall_m, std::sqrt(tuning.same_wall_m * tuning.reach_m), tuning.reach_m}) {
    const std::vector<Point2> points = cells_around(fitted, reach_m, resolution_m, is_occupied);
    if (points.size() < tuning.min_fit_cells) return wall;
    fitted = onto_line_through(points, fitted);
    if (!(cos_between(fitted, wall) > min_cosine)) return wall;
  }
  return fitted;
}

std::vector<MapSegment> supported_parts(const MapSegment& wall, double resolution_m,
                                        const std::function<bool(CellIndex)>& is_occupied,
                                        const WallSupportTuning& tuning) {
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
    if (newest >= 0 && (newest - first) * length_m >= tuning.bridge_m * steps)
      parts.push_back({point_at(first), point_at(newest)});
    newest = -1;
  };
  for (int step = 0; steps > 0 && step <= steps; ++step) {
    if (!occupied_near(point_at(step), resolution_m, tuning.reach_m, is_occupied)) continue;
    if (newest >= 0 && (step - newest) * length_m > tuning.bridge_m * steps) finish();
    if (newest < 0) first = step;
    newest = step;
  }
  finish();
  return parts;
}

namespace {

double length_of(const MapSegment& s) { return distance_m(s.start_map, s.end_map); }

bool runs_along(const MapSegment& a, const MapSegment& b, double min_cosine) {
  const double dot = (a.end_map.x_m - a.start_map.x_m) * (b.end_map.x_m - b.start_map.x_m) +
                     (a.end_map.y_m - a.start_map.y_m) * (b.end_map.y_m - b.start_map.y_m);
  return std::abs(dot) > min_cosine * length_of(a) * length_of(b);
}

/// The stretches of `wall` that none of the `drawn` walls covers.
std::vector<MapSegment> uncovered_parts(const MapSegment& wall, const std::vector<MapSegment>& drawn,
                                        const WallSupportTuning& tuning) {
  const double min_cosine = std::cos(tuning.same_wall_rad);
  const int steps = std::max(1, static_cast<int>(std::ceil(length_of(wall) / tuning.probe_m)));
  const auto point_at = [&](int step) {
    const double share = static_cast<double>(step) / steps;
    return Point2{wall.start_map.x_m + share * (wall.end_map.x_m - wall.start_map.x_m),
                  wall.start_map.y_m + share * (wall.end_map.y_m - wall.start_map.y_m)};
  };
  std::vector<MapSegment> alongside;
  std::copy_if(drawn.begin(), drawn.end(), std::back_inserter(alongside),
               [&](const MapSegment& other) { return runs_along(wall, other, min_cosine); });
  const auto is_covered = [&](const Point2& p) {
    return std::any_of(alongside.begin(), alongside.end(), [&](const MapSegment& other) {
      return distance_to_segment_m(p, other.start_map, other.end_map) < tuning.same_wall_m;
    });
  };
  std::vector<MapSegment> parts;
  int first = 0;
  for (int step = 0; step <= steps + 1; ++step) {
    if (step <= steps && !is_covered(point_at(step))) continue;
    const MapSegment part{point_at(first), point_at(std::max(first, step - 1))};
    if (length_of(part) >= tuning.bridge_m) parts.push_back(part);
    first = step + 1;
  }
  return parts;
}

}  // namespace

std::vector<MapSegment> distinct_walls(std::vector<MapSegment> walls, const WallSupportTuning& tuning) {
  std::stable_sort(walls.begin(), walls.end(),
                   [](const MapSegment& a, const MapSegment& b) { return length_of(a) > length_of(b); });
  std::vector<MapSegment> drawn;
  for (const MapSegment& wall : walls) {
    const std::vector<MapSegment> parts = uncovered_parts(wall, drawn, tuning);
    drawn.insert(drawn.end(), parts.begin(), parts.end());
  }
  return drawn;
}

}  // namespace swiftlet

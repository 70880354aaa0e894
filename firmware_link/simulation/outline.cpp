// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swiftlet {
namespace {

constexpr double kInsideM = 1e-3;

/// How far `point` lies to the left of the line from a to b.
double left_of_m(const Point2& a, const Point2& b, const Point2& point) {
  const double dx = b.x_m - a.x_m;
  const double dy = b.y_m - a.y_m;
  return (dx * (point.y_m - a.y_m) - dy * (point.x_m - a.x_m)) / std::hypot(dx, dy);
}

const Point2& corner_after(const Outline& outline, std::size_t i) {
  return outline[(i + 1) % outline.size()];
}

/// Whether all of `b` lies beyond one side of `a`, by that gap.
bool has_side_towards(const Outline& a, const Outline& b, double gap_m) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    double nearest_m = -std::numeric_limits<double>::infinity();
    for (const Point2& point : b) nearest_m = std::max(nearest_m, left_of_m(a[i], corner_after(a, i), point));
    if (nearest_m <= -gap_m) return true;
  }
  return false;
}

bool cross(const WallSegment& a, const WallSegment& b) {
  const auto parts = [](const WallSegment& wall, const WallSegment& other) {
    return left_of_m(wall.start, wall.end, other.start) * left_of_m(wall.start, wall.end, other.end) < 0.0;
  };
  return parts(a, b) && parts(b, a);
}

}  // namespace

Outline rectangle(const Pose2& T_world_local, double x0, double y0, double x1, double y1) {
  return transformed(T_world_local, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

Outline regular_polygon(const Point2& centre, double radius_m, int corners, double phase_rad) {
  Outline outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = phase_rad + 2.0 * kPi * i / corners;
    outline.push_back({centre.x_m + radius_m * std::cos(angle), centre.y_m + radius_m * std::sin(angle)});
  }
  return outline;
}

Outline transformed(const Pose2& T_a_b, const Outline& outline_b) {
  Outline outline_a;
  for (const Point2& corner : outline_b) outline_a.push_back(T_a_b * corner);
  return outline_a;
}

double distance_m(const WallSegment& wall, const Point2& point) {
  return distance_to_segment_m(point, wall.start, wall.end);
}

double distance_m(const WallSegment& a, const WallSegment& b) {
  if (cross(a, b)) return 0.0;
  return std::min(
      {distance_m(a, b.start), distance_m(a, b.end), distance_m(b, a.start), distance_m(b, a.end)});
}

bool contains(const Outline& outline, const Point2& point) {
  for (std::size_t i = 0; i < outline.size(); ++i)
    if (left_of_m(outline[i], corner_after(outline, i), point) < 0.0) return false;
  return true;
}

bool are_apart(const Outline& a, const Outline& b, double gap_m) {
  return has_side_towards(a, b, gap_m) || has_side_towards(b, a, gap_m);
}

/// Clips the wall at each side (Cyrus and Beck 1978).
std::optional<WallShare> share_inside(const WallSegment& wall, const Outline& outline) {
  WallShare inside;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const double at_start = left_of_m(outline[i], corner_after(outline, i), wall.start) - kInsideM;
    const double at_end = left_of_m(outline[i], corner_after(outline, i), wall.end) - kInsideM;
    if (at_start <= 0.0 && at_end <= 0.0) return std::nullopt;
    const double crossing = at_start / (at_start - at_end);
    if (at_start < 0.0) inside.from = std::max(inside.from, crossing);
    if (at_end < 0.0) inside.to = std::min(inside.to, crossing);
  }
  return inside.from < inside.to ? std::optional(inside) : std::nullopt;
}

}  // namespace swiftlet

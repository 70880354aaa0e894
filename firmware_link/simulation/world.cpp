// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/world.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace swiftlet {
namespace {

const double kMirrorCos = std::cos(radians(8.0));  // glass that is met more squarely sends the pulse back

/// Solves origin + t ray = start + u (end - start) for t >= 0 and u in [0, 1] by Cramer's rule.
std::optional<RayHit> intersect(const WallSegment& wall, const Point2& origin, const Point2& ray) {
  const Point2 along{wall.end.x_m - wall.start.x_m, wall.end.y_m - wall.start.y_m};
  const double determinant = ray.x_m * along.y_m - ray.y_m * along.x_m;
  const double length_m = std::hypot(along.x_m, along.y_m);
  if (std::abs(determinant) < 1e-12 * length_m) return std::nullopt;  // parallel
  const Point2 to_start{wall.start.x_m - origin.x_m, wall.start.y_m - origin.y_m};
  const double t = (to_start.x_m * along.y_m - to_start.y_m * along.x_m) / determinant;
  const double u = (to_start.x_m * ray.y_m - to_start.y_m * ray.x_m) / determinant;
  if (t < 0.0 || u < 0.0 || u > 1.0) return std::nullopt;
  const double cos_incidence = std::abs(determinant) / length_m;
  if (wall.surface == WallSurface::kGlass && cos_incidence < kMirrorCos) return std::nullopt;
  return RayHit{t, cos_incidence, wall.surface};
}

}  // namespace

std::span<const WallSegment> SimulatedWorld::walls_at(double ground_m) const {
  const auto highest = static_cast<long>(upper_walls.size());
  const long storey = std::clamp(std::lround(ground_m / storey_height_m), 0L, highest);
  return storey == 0 ? walls : upper_walls[static_cast<std::size_t>(storey - 1)];
}

std::optional<RayHit> cast_ray(std::span<const WallSegment> walls, const Point2& origin, double direction_rad,
                               double max_distance_m) {
  const Point2 ray{std::cos(direction_rad), std::sin(direction_rad)};
  std::optional<RayHit> nearest;
  for (const WallSegment& wall : walls) {
    const std::optional<RayHit> hit = intersect(wall, origin, ray);
    if (!hit || hit->distance_m > max_distance_m) continue;
    if (!nearest || hit->distance_m < nearest->distance_m) nearest = hit;
  }
  return nearest;
}

std::vector<WallSegment> walls_near(std::span<const WallSegment> walls, const Point2& origin,
                                    double distance_m) {
  std::vector<WallSegment> near;
  for (const WallSegment& wall : walls) {
    const double to_middle_m = std::hypot((wall.start.x_m + wall.end.x_m) / 2.0 - origin.x_m,
                                          (wall.start.y_m + wall.end.y_m) / 2.0 - origin.y_m);
    const double half_m = std::hypot(wall.end.x_m - wall.start.x_m, wall.end.y_m - wall.start.y_m) / 2.0;
    if (to_middle_m <= half_m + 1.001 * distance_m) near.push_back(wall);
  }
  return near;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cmath>
#include <span>

#include "core/base/check.hpp"
#include "core/geometry/point2.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

[[nodiscard]] inline Point2 mean_of(std::span<const Point2> points) {
  Point2 sum;
  for (const Point2& p : points) {
    sum.x_m += p.x_m;
    sum.y_m += p.y_m;
  }
  const auto count = static_cast<double>(points.size());
  return {sum.x_m / count, sum.y_m / count};
}

/// The rigid motion that takes points `from` nearest to points `to`, by least squares: S. Umeyama's closed
/// form (PAMI 1991) without scale. In the plane the rotation that the SVD of the covariance yields is atan2
/// of its antisymmetric and symmetric parts. The lists are paired by position. Precondition: not empty.
[[nodiscard]] inline Pose2 rigid_alignment(std::span<const Point2> from, std::span<const Point2> to) {
  SWIFTLET_CHECK(!from.empty() && from.size() == to.size(), "points are paired by position");
  const Point2 mean_from = mean_of(from);
  const Point2 mean_to = mean_of(to);
  double dot = 0.0;
  double cross = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Point2 a{from[i].x_m - mean_from.x_m, from[i].y_m - mean_from.y_m};
    const Point2 b{to[i].x_m - mean_to.x_m, to[i].y_m - mean_to.y_m};
    dot += a.x_m * b.x_m + a.y_m * b.y_m;
    cross += a.x_m * b.y_m - a.y_m * b.x_m;
  }
  const Pose2 turn(0.0, 0.0, std::atan2(cross, dot));
  const Point2 turned = turn * mean_from;
  return {mean_to.x_m - turned.x_m, mean_to.y_m - turned.y_m, turn.yaw_rad()};
}

}  // namespace swiftlet

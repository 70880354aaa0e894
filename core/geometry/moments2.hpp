// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cmath>
#include <cstddef>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Mean and covariance of weighted points in the plane. Its principal axes are those of the line with the
/// smallest sum of squared perpendicular distances.
struct Scatter2 {
  Point2 mean;
  double xx = 0.0, xy = 0.0, yy = 0.0;

  /// Variance along the line: the larger eigenvalue.
  [[nodiscard]] double along() const { return 0.5 * (xx + yy) + root(); }
  /// Variance across the line; rounding may leave it a hair below 0.
  [[nodiscard]] double across() const { return xx + yy - along(); }
  /// Unit normal of the line; along x where the points have no direction.
  [[nodiscard]] Point2 normal() const {
    // The eigenvector along the line: of its two forms the longer, which loses no digits.
    const double half = 0.5 * (xx - yy);
    const Point2 direction = half >= 0.0 ? Point2{half + root(), xy} : Point2{xy, root() - half};
    const double length = std::sqrt(direction.x_m * direction.x_m + direction.y_m * direction.y_m);
    if (!(length > 0.0)) return {1.0, 0.0};
    return {-direction.y_m / length, direction.x_m / length};
  }

 private:
  [[nodiscard]] double root() const {
    const double half = 0.5 * (xx - yy);
    return std::sqrt(half * half + xy * xy);
  }
};

/// Weighted sums over points, from which Scatter2 follows in constant time. Coordinates should be small
/// beside their scatter: large ones cost digits.
struct Moments2 {
  std::size_t count = 0;
  double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(const Point2& p, double weight = 1.0) {
    ++count;
    w += weight;
    x += weight * p.x_m;
    y += weight * p.y_m;
    xx += weight * p.x_m * p.x_m;
    xy += weight * p.x_m * p.y_m;
    yy += weight * p.y_m * p.y_m;
  }
  void merge(const Moments2& other) {
    count += other.count;
    w += other.w;
    x += other.x;
    y += other.y;
    xx += other.xx;
    xy += other.xy;
    yy += other.yy;
  }
  /// Precondition: a weight above 0 was added.
  [[nodiscard]] Scatter2 scatter() const {
    const Point2 mean{x / w, y / w};
    return {mean, xx / w - mean.x_m * mean.x_m, xy / w - mean.x_m * mean.y_m, yy / w - mean.y_m * mean.y_m};
  }
};

}  // namespace swiftlet

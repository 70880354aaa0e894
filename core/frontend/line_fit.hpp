// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "core/geometry/line2.hpp"
#include "core/geometry/moments2.hpp"

namespace swiftlet {

/// Least-squares line through points, in polar form (Garulli, Giannitrapani, Rossi, Vicino: "Mobile robot
/// SLAM for line-based environment representation", CDC 2005): the line with the smallest sum of squared
/// perpendicular distances. Kept as sums, so that two sets of points merge in constant time. Allocates
/// nothing.
class LineFit {
 public:
  void add(const Point2& p) { moments_.add(p); }
  void add(const LineFit& other) { moments_.merge(other.moments_); }

  [[nodiscard]] std::size_t count() const { return moments_.count; }
  /// The fitted line. Precondition: count() >= 2.
  [[nodiscard]] Line2 line() const;
  /// Root mean square of the points' distances from line(). Precondition: count() >= 2.
  [[nodiscard]] double rms_m() const;
  /// d line() / d p of one of the points: the rows are rho and alpha. Not defined when the points have no
  /// direction (all alike). Precondition: `line` is line() and p was added.
  [[nodiscard]] Eigen::Matrix2d jacobian(const Line2& line, const Point2& p) const;

 private:
  [[nodiscard]] Scatter2 scatter() const;

  Moments2 moments_;
};

}  // namespace swiftlet

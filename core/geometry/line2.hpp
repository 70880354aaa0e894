// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/geometry/angle.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// An infinite line in polar form: all p with p . (cos alpha, sin alpha) == rho; rho >= 0, alpha in [-pi,
/// pi). As a vector its order is (rho, alpha).
struct Line2 {
  double rho_m = 0.0;
  double alpha_rad = 0.0;

  /// Restores rho >= 0 and alpha in [-pi, pi) without moving the line.
  [[nodiscard]] Line2 normalized() const {
    if (rho_m < 0.0) return {-rho_m, wrap_angle(alpha_rad + kPi)};
    return {rho_m, wrap_angle(alpha_rad)};
  }
  /// The foot point a of eq. (6) of the paper: nearest to the origin.
  [[nodiscard]] Point2 foot() const { return {rho_m * std::cos(alpha_rad), rho_m * std::sin(alpha_rad)}; }
  /// t of eq. (7): position of the foot of the perpendicular from p along the line, in metres from foot().
  [[nodiscard]] double along_m(const Point2& p) const {
    return -p.x_m * std::sin(alpha_rad) + p.y_m * std::cos(alpha_rad);
  }
  /// Signed distance of p from the line, positive on the side away from the origin.
  [[nodiscard]] double distance_m(const Point2& p) const {
    return p.x_m * std::cos(alpha_rad) + p.y_m * std::sin(alpha_rad) - rho_m;
  }
  /// The point at `t_m` along the line: a + t d.
  [[nodiscard]] Point2 point_at(double t_m) const {
    const double c = std::cos(alpha_rad);
    const double s = std::sin(alpha_rad);
    return {rho_m * c - t_m * s, rho_m * s + t_m * c};
  }
};

/// f(x, l) of the paper (eq. 12) with its two derivatives: a line of frame a in frame b. `flipped`: rho came
/// out negative and was normalized.
struct TransformedLine {
  Line2 line_b;
  Eigen::Matrix<double, 2, 3> J_pose;  ///< d line_b / d T_b_a (x, y, yaw)
  Eigen::Matrix2d J_line;              ///< d line_b / d line_a
  bool flipped = false;
};
inline TransformedLine transform_line(const Pose2& T_b_a, const Line2& line_a) {
  const double alpha = line_a.alpha_rad + T_b_a.yaw_rad();
  const double c = std::cos(alpha);
  const double s = std::sin(alpha);
  const double rho = line_a.rho_m + T_b_a.x_m() * c + T_b_a.y_m() * s;
  const double d_alpha = -T_b_a.x_m() * s + T_b_a.y_m() * c;
  TransformedLine out;
  out.J_pose << c, s, d_alpha, 0.0, 0.0, 1.0;
  out.J_line << 1.0, d_alpha, 0.0, 1.0;
  out.flipped = rho < 0.0;
  if (out.flipped) {
    out.J_pose.row(0) *= -1.0;
    out.J_line.row(0) *= -1.0;
  }
  out.line_b = Line2{rho, alpha}.normalized();
  return out;
}

}  // namespace swiftlet

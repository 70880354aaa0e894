// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/line_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"

namespace swiftlet {

Scatter2 LineFit::scatter() const {
  SWIFTLET_CHECK(count() >= 2, "a line is fitted through two points at least");
  return moments_.scatter();
}

Line2 LineFit::line() const {
  const Scatter2 s = scatter();
  const Point2 normal = s.normal();
  return Line2{s.mean.x_m * normal.x_m + s.mean.y_m * normal.y_m, std::atan2(normal.y_m, normal.x_m)}
      .normalized();
}

double LineFit::rms_m() const { return std::sqrt(std::max(scatter().across(), 0.0)); }

Eigen::Matrix2d LineFit::jacobian(const Line2& line, const Point2& p) const {
  const Scatter2 s = scatter();
  const double n = static_cast<double>(count());
  const double numerator = -2.0 * s.xy;
  const double denominator = s.yy - s.xx;
  const double norm2 = n * (numerator * numerator + denominator * denominator);
  const double dx = p.x_m - s.mean.x_m;
  const double dy = p.y_m - s.mean.y_m;
  const double alpha_x = (numerator * dx - denominator * dy) / norm2;
  const double alpha_y = (-numerator * dy - denominator * dx) / norm2;
  const double c = std::cos(line.alpha_rad);
  const double sn = std::sin(line.alpha_rad);
  const double rho_alpha = -s.mean.x_m * sn + s.mean.y_m * c;
  Eigen::Matrix2d J;
  J << c / n + rho_alpha * alpha_x, sn / n + rho_alpha * alpha_y, alpha_x, alpha_y;
  return J;
}

}  // namespace swiftlet

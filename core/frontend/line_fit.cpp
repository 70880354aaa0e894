// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/line_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"

namespace swiftlet {

void LineFit::add(const Point2& p) {
  ++count_;
  x_ += p.x_m;
  y_ += p.y_m;
  xx_ += p.x_m * p.x_m;
  xy_ += p.x_m * p.y_m;
  yy_ += p.y_m * p.y_m;
}

void LineFit::add(const LineFit& other) {
  count_ += other.count_;
  x_ += other.x_;
  y_ += other.y_;
  xx_ += other.xx_;
  xy_ += other.xy_;
  yy_ += other.yy_;
}

LineFit::Scatter LineFit::scatter() const {
  SWIFTLET_CHECK(count_ >= 2, "a line is fitted through two points at least");
  const double n = static_cast<double>(count_);
  const Point2 mean{x_ / n, y_ / n};
  return {mean, xx_ - mean.x_m * x_, xy_ - mean.x_m * y_, yy_ - mean.y_m * y_};
}

Line2 LineFit::line() const {
  const Scatter s = scatter();
  const double alpha = 0.5 * std::atan2(-2.0 * s.xy, s.yy - s.xx);
  return Line2{s.mean.x_m * std::cos(alpha) + s.mean.y_m * std::sin(alpha), alpha}.normalized();
}

double LineFit::rms_m() const {
  const Scatter s = scatter();
  const double smaller_eigenvalue = 0.5 * (s.xx + s.yy - std::hypot(s.yy - s.xx, 2.0 * s.xy));
  return std::sqrt(std::max(smaller_eigenvalue, 0.0) / static_cast<double>(count_));
}

Eigen::Matrix2d LineFit::jacobian(const Line2& line, const Point2& p) const {
  const Scatter s = scatter();
  const double numerator = -2.0 * s.xy;
  const double denominator = s.yy - s.xx;
  const double norm2 = numerator * numerator + denominator * denominator;
  const double dx = p.x_m - s.mean.x_m;
  const double dy = p.y_m - s.mean.y_m;
  const double alpha_x = (numerator * dx - denominator * dy) / norm2;
  const double alpha_y = (-numerator * dy - denominator * dx) / norm2;
  const double c = std::cos(line.alpha_rad);
  const double sn = std::sin(line.alpha_rad);
  const double rho_alpha = -s.mean.x_m * sn + s.mean.y_m * c;
  const double n = static_cast<double>(count_);
  Eigen::Matrix2d J;
  J << c / n + rho_alpha * alpha_x, sn / n + rho_alpha * alpha_y, alpha_x, alpha_y;
  return J;
}

}  // namespace swiftlet

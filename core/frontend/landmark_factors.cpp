// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/landmark_factors.hpp"

#include <cmath>

namespace swiftlet {
namespace {

bool normals_oppose(const Line2& a, const Line2& b) {
  return std::abs(wrap_angle(a.alpha_rad - b.alpha_rad)) > 0.5 * kPi;
}

}  // namespace

LineError line_error(const Line2& measured_body, const Pose2& T_local_body, const Line2& line_local) {
  const TransformedLine predicted = transform_line(T_local_body.inverse(), line_local);
  LineError out;
  out.error = line_difference(measured_body, predicted.line_b);
  out.J_pose = -predicted.J_pose * jacobian_inverse(T_local_body);
  out.J_line = -predicted.J_line;
  if (normals_oppose(measured_body, predicted.line_b)) {
    out.J_pose.row(0) *= -1.0;
    out.J_line.row(0) *= -1.0;
  }
  return out;
}

Eigen::Vector2d line_difference(const Line2& measured, const Line2& predicted) {
  if (!normals_oppose(measured, predicted))
    return {measured.rho_m - predicted.rho_m, wrap_angle(measured.alpha_rad - predicted.alpha_rad)};
  return {measured.rho_m + predicted.rho_m, wrap_angle(measured.alpha_rad - predicted.alpha_rad - kPi)};
}

}  // namespace swiftlet

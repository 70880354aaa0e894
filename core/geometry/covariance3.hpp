// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>

namespace swiftlet {

/// A symmetric 3x3 matrix over (x, y, yaw) in m^2, m rad, rad^2, as a plain struct that may cross a queue.
struct Covariance3 {
  double xx = 0.0, xy = 0.0, x_yaw = 0.0, yy = 0.0, y_yaw = 0.0, yaw_yaw = 0.0;

  static Covariance3 from_matrix(const Eigen::Matrix3d& P) {
    return {P(0, 0), P(0, 1), P(0, 2), P(1, 1), P(1, 2), P(2, 2)};
  }
  [[nodiscard]] Eigen::Matrix3d matrix() const {
    Eigen::Matrix3d P;
    P << xx, xy, x_yaw, xy, yy, y_yaw, x_yaw, y_yaw, yaw_yaw;
    return P;
  }
};

}  // namespace swiftlet

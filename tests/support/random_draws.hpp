// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <random>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

inline double random_in(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
inline int random_int(std::mt19937& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}
/// Anywhere in the square of +-`reach_m`, in any direction.
inline Pose2 random_pose(std::mt19937& random, double reach_m) {
  const double x_m = random_in(random, -reach_m, reach_m);
  const double y_m = random_in(random, -reach_m, reach_m);
  return {x_m, y_m, random_in(random, -kPi, kPi)};
}
/// Symmetric positive definite, eigenvalues of at least `floor`.
inline Eigen::Matrix3d random_covariance(std::mt19937& random, double floor) {
  const Eigen::Matrix3d A = Eigen::Matrix3d::NullaryExpr([&] { return random_in(random, -1.0, 1.0); });
  return A * A.transpose() + floor * Eigen::Matrix3d::Identity();
}

}  // namespace swiftlet

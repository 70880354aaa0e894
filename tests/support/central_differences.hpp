// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Derivative of a pose vector (x, y, yaw) by another, by central differences: the slow twin of every
/// analytic Jacobian. `function` takes and returns an Eigen::Vector3d; its last component is an angle.
template <typename Function>
Eigen::Matrix3d central_differences(const Function& function, const Eigen::Vector3d& at) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix3d J;
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector3d delta = Eigen::Vector3d::Zero();
    delta[i] = kStep;
    Eigen::Vector3d difference =
        function(Eigen::Vector3d(at + delta)) - function(Eigen::Vector3d(at - delta));
    difference[2] = wrap_angle(difference[2]);
    J.col(i) = difference / (2.0 * kStep);
  }
  return J;
}

inline Pose2 pose_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace swiftlet

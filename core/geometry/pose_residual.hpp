// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// By how much two poses miss a motion that was measured between them: e = z^-1 (+) (y_i^-1 (+) y_j), eqs. 10
/// and 24 of "Efficient 2D Graph SLAM for Sparse Sensing" (Zhou, Hu, Liu, Khan; IROS 2022). Order (x, y,
/// yaw), in the frame of the measured end of the motion.
struct PoseResidual {
  Eigen::Vector3d error;
  Eigen::Matrix3d J_from;  ///< d error / d T_w_from
  Eigen::Matrix3d J_to;    ///< d error / d T_w_to
};

/// Allocates nothing.
inline PoseResidual pose_residual(const Pose2& T_from_to, const Pose2& T_w_from, const Pose2& T_w_to) {
  const Pose2 T_from_w = T_w_from.inverse();
  const Pose2 T_z = T_from_to.inverse();
  const Eigen::Matrix3d J_now = jacobian_compose_second(T_z);
  return {(T_z * (T_from_w * T_w_to)).vector(),
          J_now * jacobian_compose_first(T_from_w, T_w_to) * jacobian_inverse(T_w_from),
          J_now * jacobian_compose_second(T_from_w)};
}

/// The covariance of a measured motion (of T_from_to as a vector, in the frame of `from`) as the information
/// of pose_residual()'s error. Precondition: positive definite. Allocates nothing.
inline Eigen::Matrix3d residual_information(const Pose2& T_from_to, const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix3d J = jacobian_compose_second(T_from_to.inverse());
  const Eigen::Matrix3d information = (J * covariance * J.transpose()).inverse();
  return 0.5 * (information + information.transpose());
}

}  // namespace swiftlet

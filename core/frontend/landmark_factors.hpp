// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>

#include "core/geometry/line2.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

// The error terms of eq. (9) of "Efficient 2D Graph SLAM for Sparse Sensing" (Zhou, Hu, Liu, Khan; IROS 2022)
// with their derivatives. Poses and lines are in the local frame. Nothing here allocates.

/// e_o of eq. (10): order (x, y, yaw), in the frame of the measured end of the motion.
struct MotionResidual {
  Eigen::Vector3d error;
  Eigen::Matrix3d J_from;  ///< d error / d T_local_from
  Eigen::Matrix3d J_to;    ///< d error / d T_local_to
};
MotionResidual motion_residual(const Pose2& T_from_to_measured, const Pose2& T_local_from,
                               const Pose2& T_local_to);

/// Information matrix of e_o for a measured motion with `covariance` (of T_from_to as a vector).
/// Precondition: the covariance is positive definite.
Eigen::Matrix3d motion_information(const Pose2& T_from_to_measured, const Eigen::Matrix3d& covariance);

/// e_l of eq. (11): order (rho, alpha). The predicted line gets the sign of rho that turns its normal towards
/// the measured one, so that a landmark whose extension is near the vehicle does not jump by pi.
struct LineError {
  Eigen::Vector2d error;
  Eigen::Matrix<double, 2, 3> J_pose;  ///< d error / d T_local_body
  Eigen::Matrix2d J_line;              ///< d error / d line_local
};
LineError line_error(const Line2& measured_body, const Pose2& T_local_body, const Line2& line_local);

/// `measured` less `predicted` as a vector, both normals brought to the same side.
Eigen::Vector2d line_difference(const Line2& measured, const Line2& predicted);

}  // namespace swiftlet

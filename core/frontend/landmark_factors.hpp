// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>

#include "core/geometry/line2.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

// The error of a line in eq. (9) of "Efficient 2D Graph SLAM for Sparse Sensing" (Zhou, Hu, Liu, Khan; IROS
// 2022) with its derivatives. Poses and lines are in the local frame. Nothing here allocates.

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

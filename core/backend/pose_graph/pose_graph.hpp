// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/ids.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// One relative measurement between two keyframes, z = T_from_to.
struct PoseConstraint {
  KeyframeId from{};
  KeyframeId to{};
  Pose2 T_from_to;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< of z's error, in the frame of `to` (eq. 24)
  bool is_closure = false;                                    ///< subject to DCS
  double dcs_scale = 1.0;  ///< written by the optimizer: 1 fully believed, towards 0 refused
};

/// A keyframe's heading, known by other means than motion. Subject to DCS.
struct HeadingConstraint {
  KeyframeId keyframe{};
  double yaw_map_rad = 0.0;
  double information = 1.0;  ///< 1 / rad^2
  double dcs_scale = 1.0;    ///< as a PoseConstraint's
};

struct PoseGraph {
  std::vector<Pose2> T_map_keyframe;  ///< the first one is held fixed
  std::vector<PoseConstraint> constraints;
  std::vector<HeadingConstraint> headings;
};

/// Eq. 10 and 24: e = z^-1 (+) (y_i^-1 (+) y_j), with its derivatives by (x, y, yaw) of both poses.
struct PoseResidual {
  Eigen::Vector3d error;
  Eigen::Matrix3d J_from;
  Eigen::Matrix3d J_to;
};
PoseResidual pose_residual(const Pose2& T_from_to, const Pose2& T_map_from, const Pose2& T_map_to);

/// How far the poses are from what is measured, in units of the measurement's noise.
[[nodiscard]] double chi_square(const PoseConstraint& constraint, const std::vector<Pose2>& T_map_keyframe);
[[nodiscard]] double chi_square(const HeadingConstraint& constraint,
                                const std::vector<Pose2>& T_map_keyframe);

/// The covariance of a composition's vector (x, y, yaw of T_from_to, in the frame of `from`), as the
/// information of eq. 24's error, which is expressed in the frame of `to`.
Eigen::Matrix3d residual_information(const Pose2& T_from_to, const Eigen::Matrix3d& covariance);

/// DCS (Agarwal et al. 2013, "Robust map optimization using dynamic covariance scaling", eq. 15): the factor
/// on a closure's error of the given chi-square.
double dcs_scale(double chi_square, double phi);

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/pose_graph.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

template <AnId Id>
double relative_chi_square(const RelativePoseFactor<Id>& f, const Pose2& T_map_from, const Pose2& T_map_to) {
  const PoseResidual r = pose_residual(f.T_from_to, T_map_from, T_map_to);
  return r.error.dot(f.information * r.error);
}

template <AnId Id>
double heading_chi_square(const HeadingFactor<Id>& f, const Pose2& T_map_pose) {
  const double error_rad = wrap_angle(T_map_pose.yaw_rad() - f.yaw_map_rad);
  return f.information * error_rad * error_rad;
}

}  // namespace

PoseResidual pose_residual(const Pose2& T_from_to, const Pose2& T_map_from, const Pose2& T_map_to) {
  const Pose2 T_from_map = T_map_from.inverse();
  const Pose2 T_from_to_now = T_from_map * T_map_to;
  const Pose2 T_z = T_from_to.inverse();
  PoseResidual r;
  r.error = (T_z * T_from_to_now).vector();
  const Eigen::Matrix3d J_now = jacobian_compose_second(T_z);
  r.J_from = J_now * jacobian_compose_first(T_from_map, T_map_to) * jacobian_inverse(T_map_from);
  r.J_to = J_now * jacobian_compose_second(T_from_map);
  return r;
}

double chi_square(const RelativePoseFactor<KeyframeId>& f, const KeyframePoses& T_map_keyframe) {
  return relative_chi_square(f, T_map_keyframe[f.from], T_map_keyframe[f.to]);
}

double chi_square(const HeadingFactor<KeyframeId>& f, const KeyframePoses& T_map_keyframe) {
  return heading_chi_square(f, T_map_keyframe[f.pose]);
}

double chi_square(const RelativePoseFactor<PoseIndex>& f, const std::vector<Pose2>& T_map_pose) {
  return relative_chi_square(f, T_map_pose[index_of(f.from)], T_map_pose[index_of(f.to)]);
}

double chi_square(const HeadingFactor<PoseIndex>& f, const std::vector<Pose2>& T_map_pose) {
  return heading_chi_square(f, T_map_pose[index_of(f.pose)]);
}

Eigen::Matrix3d residual_information(const Pose2& T_from_to, const Eigen::Matrix3d& covariance) {
  // With y_i^-1 (+) y_j = z (+) d: e turns the translation by -yaw(z).
  const Eigen::Matrix3d R_to_from = jacobian_compose_second(T_from_to).transpose();
  return (R_to_from * covariance * R_to_from.transpose()).inverse();
}

double dcs_scale(double chi_square, double phi) { return std::min(1.0, 2.0 * phi / (phi + chi_square)); }

double dcs_cost(double chi_square, double phi) {
  if (chi_square <= phi) return chi_square;
  return phi * (3.0 * chi_square - phi) / (phi + chi_square);
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/pose_graph.hpp"

#include <algorithm>

#include "core/geometry/angle.hpp"
#include "core/geometry/pose_residual.hpp"

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

double dcs_scale(double chi_square, double phi) { return std::min(1.0, 2.0 * phi / (phi + chi_square)); }

double dcs_cost(double chi_square, double phi) {
  if (chi_square <= phi) return chi_square;
  return phi * (3.0 * chi_square - phi) / (phi + chi_square);
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/confidence/pose_confidence.hpp"

namespace swiftlet {

std::string_view name_of(Tracking tracking) {
  switch (tracking) {
    case Tracking::kTracking:
      return "tracking";
    case Tracking::kUncertain:
      return "uncertain";
    case Tracking::kLost:
      return "lost";
    case Tracking::kRelocalizing:
      break;
  }
  return "relocalizing";
}

Covariance3 carried_on(const Covariance3& of_keyframe, const PoseConfidence& confidence,
                       const Pose2& T_local_body) {
  const Pose2 T_map_local(0.0, 0.0, confidence.yaw_map_local_rad);  // its direction alone
  const Pose2 T_map_keyframe = T_map_local * confidence.T_local_keyframe;
  const Pose2 T_keyframe_body = between(confidence.T_local_keyframe, T_local_body);
  const Eigen::Matrix3d J1 = jacobian_compose_first(T_map_keyframe, T_keyframe_body);
  const Eigen::Matrix3d J2 = jacobian_compose_second(T_map_keyframe);
  return Covariance3::from_matrix(J1 * of_keyframe.matrix() * J1.transpose() +
                                  J2 * confidence.slip.covariance(T_keyframe_body) * J2.transpose());
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/confidence/pose_covariances.hpp"

#include <cmath>
#include <limits>

#include "core/backend/pose_graph/relative_uncertainty.hpp"

namespace swiftlet {
namespace {

/// The keyframe whose pose stands for the map around the newest, on its storey.
KeyframeId surroundings_of_newest(const PoseGraph& graph, const KeyframeChain& chain,
                                  const IdMap<KeyframeId, Eigen::Matrix3d>& covariances,
                                  const ConfidenceTuning& tuning) {
  const KeyframeId newest = chain.all().last_id();
  const Pose2& T_map_newest = graph.T_map_keyframe[newest];
  KeyframeId chosen = newest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const KeyframeId id = chain.all().id_at(i);
    const bool is_old = chain.path_m(newest) - chain.path_m(id) > tuning.old_after_m;
    if (!is_old && chosen != newest) break;
    if (chain.storey(id) != chain.storey(newest)) continue;
    const Pose2 off = between(T_map_newest, graph.T_map_keyframe[id]);
    if (std::hypot(off.x_m(), off.y_m()) > tuning.near_m) continue;
    const Eigen::Matrix3d& P = covariances[id];
    if (P(0, 0) + P(1, 1) >= least) continue;
    least = P(0, 0) + P(1, 1);
    chosen = id;
  }
  return chosen;
}

}  // namespace

PoseCovariances newest_pose_covariances(const PoseGraph& graph, const KeyframeChain& chain,
                                        const BackendTuning& tuning) {
  const ConfidenceTuning& confidence = tuning.confidence;
  const CorrelativeMatcherTuning& matcher = tuning.matcher;
  const KeyframeId newest = chain.all().last_id();
  const IdMap<KeyframeId, Eigen::Matrix3d> covariances = cautious_relative_covariances(
      graph, newest, tuning.covariance, {confidence.slip_along_m2_per_m, confidence.slip_yaw_rad2_per_m});
  const double floor_m2 = matcher.floor_sigma_m * matcher.floor_sigma_m;
  const Eigen::Vector3d floor(floor_m2, floor_m2, matcher.floor_sigma_yaw_rad * matcher.floor_sigma_yaw_rad);
  const auto relative_to = [&](KeyframeId id) {
    const Pose2 T_newest_id = between(graph.T_map_keyframe[newest], graph.T_map_keyframe[id]);
    const Eigen::Matrix3d J =
        jacobian_compose_second(graph.T_map_keyframe[id]) * jacobian_inverse(T_newest_id);
    Eigen::Matrix3d P = J * covariances[id] * J.transpose();
    P.diagonal() += floor;
    return Covariance3::from_matrix(P);
  };
  return {relative_to(chain.all().first_id()),
          relative_to(surroundings_of_newest(graph, chain, covariances, confidence))};
}

}  // namespace swiftlet

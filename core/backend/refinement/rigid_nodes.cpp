// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/rigid_nodes.hpp"

#include <cmath>
#include <utility>

namespace swiftlet {

NodeError node_error(const PoseInNode& predicted, const Pose2& moved) {
  const Pose2 T_predicted_from = predicted.T_node_body.inverse();
  return {(T_predicted_from * moved).vector(), jacobian_compose_first(T_predicted_from, moved) *
                                                   jacobian_inverse(predicted.T_node_body) *
                                                   predicted.by_errors};
}

RigidNodes::RigidNodes(std::vector<TimedOdometry> scans, std::vector<StepVariance> variance_to,
                       const RigidNodesTuning& tuning)
    : motion_(scans),
      variance_to_(std::move(variance_to)),
      node_of_(scans.size()),
      in_node_(scans.size()),
      steps_(scans.size()),
      reckoned_m2_(scans.size(), 0.0) {
  divide(scans, tuning);
  reckon(SystematicErrors::Zero());
}

void RigidNodes::divide(std::span<const TimedOdometry> scans, const RigidNodesTuning& tuning) {
  double way_m = 0.0;
  double turn_rad = 0.0;
  StepVariance variance;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const bool is_known = i > 0 && motion_.is_known(i);
    if (i > 0) {
      variance.xy_m2 += variance_to_[i].xy_m2;
      variance.yaw_rad2 += variance_to_[i].yaw_rad2;
      reckoned_m2_[i] = reckoned_m2_[i - 1] + variance_to_[i].xy_m2;
    }
    if (is_known) {
      const Pose2 step = motion_.measured(i);
      way_m += std::hypot(step.x_m(), step.y_m());
      turn_rad += std::abs(step.yaw_rad());
    }
    if (!is_known || way_m > tuning.way_m || turn_rad > tuning.turn_rad ||
        to_seconds(scans[i].measured_at - scans[nodes_.back().first].measured_at) > tuning.duration_s) {
      nodes_.push_back({i, variance, {}});
      way_m = turn_rad = 0.0;
      variance = {};
    }
    node_of_[i] = static_cast<std::uint32_t>(nodes_.size() - 1);
  }
}

void RigidNodes::reckon(const SystematicErrors& errors) {
  const std::span<const CorrectedStep> corrected = motion_.correct(errors);
  for (std::size_t i = 1; i < in_node_.size(); ++i) {
    const bool is_known = motion_.is_known(i);
    steps_[i] = is_known ? corrected[i].T_previous_this : motion_.measured(i);
    const PoseInNode& before = in_node_[i - 1];
    PoseInNode& here = node_of_[i] == node_of_[i - 1] ? in_node_[i] : nodes_[node_of_[i - 1]].next;
    here.T_node_body = before.T_node_body * steps_[i];
    here.by_errors = jacobian_compose_first(before.T_node_body, steps_[i]) * before.by_errors;
    if (is_known) here.by_errors += jacobian_compose_second(before.T_node_body) * corrected[i].by_errors;
  }
}

/// Half of the variance that a node gathers, from the first scan of the run.
double RigidNodes::middle_m2(std::size_t node) const {
  const std::size_t end = node + 1 < nodes_.size() ? nodes_[node + 1].first : in_node_.size();
  return 0.5 * (reckoned_m2_[nodes_[node].first] + reckoned_m2_[end - 1]);
}

std::vector<Pose2> RigidNodes::blended(std::span<const Pose2> T_map_node) const {
  std::vector<Pose2> T_map_body(in_node_.size());
  for (std::size_t i = 0; i < in_node_.size(); ++i) {
    const std::size_t node = node_of_[i];
    T_map_body[i] = T_map_node[node] * in_node_[i].T_node_body;
    const double from_middle_m2 = reckoned_m2_[i] - middle_m2(node);
    const bool is_late = from_middle_m2 > 0.0;
    const std::size_t later = is_late ? node + 1 : node;  // of the two nodes
    if (later == 0 || later == nodes_.size() || !motion_.is_known(nodes_[later].first)) continue;
    const Pose2 T_later_earlier = nodes_[later - 1].next.T_node_body.inverse();
    const Pose2 T_map_other = is_late ? T_map_node[later] * T_later_earlier
                                      : T_map_node[later - 1] * nodes_[later - 1].next.T_node_body;
    const double share = std::abs(from_middle_m2) / (middle_m2(later) - middle_m2(later - 1));
    const Eigen::Vector3d apart = between(T_map_body[i], T_map_other * in_node_[i].T_node_body).vector();
    T_map_body[i] = T_map_body[i] * Pose2(share * apart(0), share * apart(1), share * apart(2));
  }
  return T_map_body;
}

}  // namespace swiftlet

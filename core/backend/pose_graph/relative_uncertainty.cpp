// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/relative_uncertainty.hpp"

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>

namespace swiftlet {
namespace {

constexpr double kBelieved = 0.5;

struct Step {
  std::uint32_t to = 0;
  Eigen::Matrix3d covariance;  ///< of T_here_to, in the frame of here
  double length = 0.0;         ///< what Dijkstra adds up
};

double size_of(const Eigen::Matrix3d& covariance) {
  constexpr double kLeverM2 = 4.0;  // a heading error is felt at about two metres, the reach of the beams
  return covariance(0, 0) + covariance(1, 1) + kLeverM2 * covariance(2, 2);
}

std::vector<std::vector<Step>> steps_of(const PoseGraph& graph) {
  std::vector<std::vector<Step>> steps(graph.T_map_keyframe.size());
  for (const RelativePoseFactor<KeyframeId>& c : graph.factors.values()) {
    if (c.is_closure && c.dcs_scale < kBelieved) continue;
    // The factor's error is in the frame of `to`; T_from_to moves with it by R(from <- to).
    const Eigen::Matrix3d in_to = c.information.inverse();
    const Eigen::Matrix3d J = jacobian_compose_second(c.T_from_to);
    const Eigen::Matrix3d forward = J * in_to * J.transpose();
    const Eigen::Matrix3d J_back = jacobian_inverse(c.T_from_to);
    const Eigen::Matrix3d backward = J_back * forward * J_back.transpose();
    const double length = size_of(forward);
    const std::uint32_t from = index_of(graph.pose_index(c.from));
    const std::uint32_t to = index_of(graph.pose_index(c.to));
    steps[from].push_back({to, forward, length});
    steps[to].push_back({from, backward, length});
  }
  return steps;
}

/// Variance of each keyframe's heading in the map by what the graph's headings say; infinite where nothing.
std::vector<double> heading_variances(const PoseGraph& graph) {
  std::vector<double> variances(graph.T_map_keyframe.size(), std::numeric_limits<double>::infinity());
  for (const HeadingFactor<KeyframeId>& c : graph.headings) {
    if (c.dcs_scale >= kBelieved) variances[index_of(graph.pose_index(c.pose))] = 1.0 / c.information;
  }
  return variances;
}

/// Kalman update of a pose's covariance by its heading.
void know_heading(double variance_rad2, Eigen::Matrix3d& covariance) {
  if (!std::isfinite(variance_rad2)) return;
  const Eigen::Vector3d column = covariance.col(2);
  covariance -= column * column.transpose() / (covariance(2, 2) + variance_rad2);
}

}  // namespace

IdMap<KeyframeId, Eigen::Matrix3d> relative_covariances(const PoseGraph& graph, KeyframeId from) {
  const auto steps = steps_of(graph);
  const std::vector<double> headings = heading_variances(graph);
  const std::span<const Pose2> T_map_pose = graph.T_map_keyframe.values();
  const std::uint32_t start = index_of(graph.pose_index(from));
  std::vector<double> distance(T_map_pose.size(), std::numeric_limits<double>::infinity());
  std::vector<Eigen::Matrix3d> covariance(T_map_pose.size(), Eigen::Matrix3d::Identity() * 1e6);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const Pose2 T_from_map = T_map_pose[start].inverse();
  distance[start] = 0.0;
  covariance[start].setZero();
  open.emplace(0.0, start);
  while (!open.empty()) {
    const auto [length, here] = open.top();
    open.pop();
    if (length > distance[here]) continue;
    const Pose2 T_from_here = T_from_map * T_map_pose[here];
    for (const Step& step : steps[here]) {
      const double candidate = length + step.length;
      if (candidate >= distance[step.to]) continue;
      distance[step.to] = candidate;
      const Pose2 T_here_to = between(T_map_pose[here], T_map_pose[step.to]);
      const Eigen::Matrix3d J1 = jacobian_compose_first(T_from_here, T_here_to);
      const Eigen::Matrix3d J2 = jacobian_compose_second(T_from_here);
      covariance[step.to] = J1 * covariance[here] * J1.transpose() + J2 * step.covariance * J2.transpose();
      know_heading(2.0 * headings[step.to], covariance[step.to]);  // that of `from` is known no better
      open.emplace(candidate, step.to);
    }
  }
  return graph.T_map_keyframe.with(std::move(covariance));
}

}  // namespace swiftlet

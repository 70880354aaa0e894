// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/relative_uncertainty.hpp"

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <span>
#include <utility>
#include <vector>

namespace swiftlet {
namespace {

struct Step {
  PoseIndex to{};
  std::uint32_t factor = 0;  ///< where it lies among the graph's
  double length = 0.0;       ///< what Dijkstra adds up
};

double size_of(const Eigen::Matrix3d& covariance, double lever_m) {
  return covariance(0, 0) + covariance(1, 1) + lever_m * lever_m * covariance(2, 2);
}

/// The factors that count, as steps from pose to pose. Those from one pose lie together, in the order of the
/// factors.
class Steps {
 public:
  Steps(const PoseGraph& graph, const RelativeCovarianceTuning& tuning, const SlipNoise& slip)
      : graph_(&graph),
        tuning_(tuning),
        slip_(slip),
        first_(graph.T_map_keyframe.size() + 2, 0),
        forward_(graph.factors.size()) {
    std::uint32_t count = 0;
    for (const Factor& f : graph.factors.values()) {
      if (!is_used(f)) continue;
      ++first_[index_of(graph.pose_index(f.from)) + 2];
      ++first_[index_of(graph.pose_index(f.to)) + 2];
      count += 2;
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    steps_.resize(count);
    for (std::uint32_t i = 0; i < graph.factors.size(); ++i)
      if (is_used(graph.factors.values()[i])) insert(i);
  }

  [[nodiscard]] std::span<const Step> from(PoseIndex pose) const {
    const std::uint32_t first = first_[index_of(pose)];
    return std::span(steps_).subspan(first, first_[index_of(pose + 1)] - first);
  }

  /// Of T_here_to, in the frame of here.
  [[nodiscard]] Eigen::Matrix3d covariance(const Step& step) const {
    const Factor& f = graph_->factors.values()[step.factor];
    const Eigen::Matrix3d& forward = forward_[step.factor];
    if (step.to == graph_->pose_index(f.to)) return forward;
    const Eigen::Matrix3d J_back = jacobian_inverse(f.T_from_to);
    return J_back * forward * J_back.transpose();
  }

 private:
  using Factor = RelativePoseFactor<KeyframeId>;

  [[nodiscard]] bool is_used(const Factor& f) const {
    return !f.is_closure || (f.dcs_scale >= tuning_.min_dcs_scale && !f.information.isZero(0.0));
  }

  /// While filling, first_[p + 1] is where the next step from p goes.
  void insert(std::uint32_t i) {
    const Factor& f = graph_->factors.values()[i];
    // The factor's error is in the frame of `to`; T_from_to moves with it by R(from <- to).
    const Eigen::Matrix3d in_to = f.information.inverse();
    const Eigen::Matrix3d J = jacobian_compose_second(f.T_from_to);
    forward_[i] = J * in_to * J.transpose();
    if (!f.is_closure) forward_[i] += slip_.covariance(f.T_from_to);
    const double length = size_of(forward_[i], tuning_.lever_m);
    const PoseIndex from = graph_->pose_index(f.from);
    const PoseIndex to = graph_->pose_index(f.to);
    steps_[first_[index_of(from) + 1]++] = {to, i, length};
    steps_[first_[index_of(to) + 1]++] = {from, i, length};
  }

  const PoseGraph* graph_;
  RelativeCovarianceTuning tuning_;
  SlipNoise slip_;
  std::vector<std::uint32_t> first_;  ///< by pose: of its steps
  std::vector<Step> steps_;
  std::vector<Eigen::Matrix3d> forward_;  ///< by factor: of T_from_to, in the frame of `from`
};

/// A step that led to a pose, and the pose it came from.
struct Arrival {
  PoseIndex here{};
  Step step;
};

/// Variance of each keyframe's heading by the graph's heading factors; infinite without one.
std::vector<double> heading_variances(const PoseGraph& graph, double min_dcs_scale) {
  std::vector<double> variances(graph.T_map_keyframe.size(), std::numeric_limits<double>::infinity());
  for (const HeadingFactor<KeyframeId>& c : graph.headings) {
    if (c.dcs_scale >= min_dcs_scale) variances[index_of(graph.pose_index(c.pose))] = 1.0 / c.information;
  }
  return variances;
}

/// Kalman update of a pose's covariance by its heading.
void condition_on_heading(double variance_rad2, Eigen::Matrix3d& covariance) {
  if (!std::isfinite(variance_rad2)) return;
  const Eigen::Vector3d column = covariance.col(2);
  covariance -= column * column.transpose() / (covariance(2, 2) + variance_rad2);
}

IdMap<KeyframeId, Eigen::Matrix3d> propagate(const PoseGraph& graph, KeyframeId from, const Steps& steps,
                                             const std::vector<double>& headings) {
  const std::span<const Pose2> T_map_pose = graph.T_map_keyframe.values();
  const PoseIndex start = graph.pose_index(from);
  const Pose2 T_from_map = T_map_pose[index_of(start)].inverse();
  std::vector<Eigen::Matrix3d> covariance(T_map_pose.size(), Eigen::Matrix3d::Identity() * 1e6);
  // Variance of the heading of `from` by the first heading on the way to each pose.
  std::vector<double> of_from(T_map_pose.size(), std::numeric_limits<double>::infinity());
  of_from[index_of(start)] = headings[index_of(start)];
  const auto carry_on = [&](const Arrival& arrival) {
    const std::uint32_t here = index_of(arrival.here);
    const std::uint32_t to = index_of(arrival.step.to);
    const Pose2 T_from_here = T_from_map * T_map_pose[here];
    const Eigen::Matrix3d J1 = jacobian_compose_first(T_from_here, between(T_map_pose[here], T_map_pose[to]));
    const Eigen::Matrix3d J2 = jacobian_compose_second(T_from_here);
    covariance[to] =
        J1 * covariance[here] * J1.transpose() + J2 * steps.covariance(arrival.step) * J2.transpose();
    of_from[to] = of_from[here];
    if (std::isfinite(of_from[to]))
      condition_on_heading(headings[to] + of_from[to], covariance[to]);
    else
      of_from[to] = headings[to] + covariance[to](2, 2);
  };
  std::vector<Arrival> arrivals(T_map_pose.size());
  std::vector<double> distance(T_map_pose.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, PoseIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  distance[index_of(start)] = 0.0;
  covariance[index_of(start)].setZero();
  open.emplace(0.0, start);
  while (!open.empty()) {
    const auto [length, here] = open.top();
    open.pop();
    if (length > distance[index_of(here)]) continue;
    if (here != start) carry_on(arrivals[index_of(here)]);
    for (const Step& step : steps.from(here)) {
      const double candidate = length + step.length;
      if (candidate >= distance[index_of(step.to)]) continue;
      distance[index_of(step.to)] = candidate;
      arrivals[index_of(step.to)] = {here, step};
      open.emplace(candidate, step.to);
    }
  }
  return graph.T_map_keyframe.with(std::move(covariance));
}

}  // namespace

IdMap<KeyframeId, Eigen::Matrix3d> relative_covariances(const PoseGraph& graph, KeyframeId from,
                                                        const RelativeCovarianceTuning& tuning) {
  return propagate(graph, from, Steps(graph, tuning, {}), heading_variances(graph, tuning.min_dcs_scale));
}

IdMap<KeyframeId, Eigen::Matrix3d> cautious_relative_covariances(const PoseGraph& graph, KeyframeId from,
                                                                 const RelativeCovarianceTuning& tuning,
                                                                 const SlipNoise& slip) {
  const double unknown = std::numeric_limits<double>::infinity();
  return propagate(graph, from, Steps(graph, tuning, slip),
                   std::vector<double>(graph.T_map_keyframe.size(), unknown));
}

}  // namespace swiftlet

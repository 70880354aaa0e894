// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/closure_groups.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/backend/pose_graph/relative_uncertainty.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensing/odometry_covariance.hpp"

namespace swiftlet {
namespace {

UncertainMotion inverse(const UncertainMotion& a) {
  const Eigen::Matrix3d J = jacobian_inverse(a.T_from_to);
  return {a.T_from_to.inverse(), J * a.covariance * J.transpose()};
}

UncertainMotion measured(const LoopClosure& closure) {
  return {closure.T_from_to, closure.covariance.matrix()};
}

UncertainMotion by_graph(const PoseGraph& graph, KeyframeId from, KeyframeId to,
                         const Eigen::Matrix3d& covariance) {
  return {between(graph.T_map_keyframe[from], graph.T_map_keyframe[to]), covariance};
}

}  // namespace

void ClosureGroups::forget_before(double path_m) {
  const auto first_kept = std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& w) {
    return chain_->path_m(w.closure.to) >= path_m;
  });
  const std::size_t surplus =
      waiting_.size() > tuning_.max_waiting ? waiting_.size() - tuning_.max_waiting : 0;
  const std::size_t gone = std::max(static_cast<std::size_t>(first_kept - waiting_.begin()), surplus);
  if (gone == 0) return;
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(gone));
  for (Waiting& w : waiting_) {
    w.agreeing.erase(w.agreeing.begin(), std::lower_bound(w.agreeing.begin(), w.agreeing.end(), gone));
    for (std::size_t& other : w.agreeing) other -= gone;
  }
}

/// Matches agree if the motion from one query to the other is the same through the graph and both submaps.
void ClosureGroups::admit(const LoopClosure& closure, const PoseGraph& graph,
                          const IdMap<KeyframeId, Eigen::Matrix3d>& covariances_query) {
  Waiting entry{closure, {}};
  const IdMap<KeyframeId, Eigen::Matrix3d> covariances_submap =
      waiting_.empty() ? IdMap<KeyframeId, Eigen::Matrix3d>()
                       : relative_covariances(graph, closure.from, covariance_tuning_);
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const LoopClosure& other = waiting_[i].closure;
    const UncertainMotion T_q_other = by_graph(graph, closure.to, other.to, covariances_query[other.to]);
    const UncertainMotion T_s_other =
        by_graph(graph, closure.from, other.from, covariances_submap[other.from]);
    const UncertainMotion T_q_other_matched = inverse(measured(closure)) * T_s_other * measured(other);
    Eigen::Vector3d off = T_q_other_matched.T_from_to.vector() - T_q_other.T_from_to.vector();
    off(2) = wrap_angle(off(2));
    const Eigen::Matrix3d covariance = T_q_other_matched.covariance + T_q_other.covariance;
    if (off.dot(covariance.inverse() * off) > tuning_.max_chi_square) continue;
    entry.agreeing.push_back(i);
    waiting_[i].agreeing.push_back(waiting_.size());
  }
  waiting_.push_back(std::move(entry));
}

/// Greedily the largest set around `seed` in which all agree: the next member agrees with most of those left.
std::vector<std::size_t> ClosureGroups::agreeing_set(std::size_t seed) const {
  std::vector<std::size_t> set{seed};
  std::vector<std::size_t> left = waiting_[seed].agreeing;
  while (!left.empty()) {
    std::size_t best = left.front();
    std::vector<std::size_t> best_left;
    for (const std::size_t i : left) {
      std::vector<std::size_t> common;
      const std::vector<std::size_t>& agreeing = waiting_[i].agreeing;
      std::set_intersection(left.begin(), left.end(), agreeing.begin(), agreeing.end(),
                            std::back_inserter(common));
      if (common.size() <= best_left.size()) continue;
      best = i;
      best_left = std::move(common);
    }
    set.push_back(best);
    left = std::move(best_left);
  }
  std::sort(set.begin(), set.end());
  return set;
}

/// Size of the largest agreeing set that shares no member with this one.
std::size_t ClosureGroups::largest_rival(std::span<const std::size_t> set) const {
  std::size_t largest = 0;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    if (std::binary_search(set.begin(), set.end(), i) || waiting_[i].agreeing.size() < largest) continue;
    const std::vector<std::size_t> rival = agreeing_set(i);
    std::vector<std::size_t> shared;
    std::set_intersection(set.begin(), set.end(), rival.begin(), rival.end(), std::back_inserter(shared));
    if (shared.empty()) largest = std::max(largest, rival.size());
  }
  return largest;
}

/// Information on the position, in the axes of the map, from members whose queries are not near `left_out`'s.
Eigen::Matrix2d ClosureGroups::information_without(std::size_t left_out, std::span<const std::size_t> set,
                                                   const PoseGraph& graph) const {
  const double left_out_m = chain_->path_m(waiting_[left_out].closure.to);
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (const std::size_t i : set) {
    const LoopClosure& c = waiting_[i].closure;
    if (std::abs(chain_->path_m(c.to) - left_out_m) < tuning_.near_m) continue;
    const double turn_rad = graph.T_map_keyframe[c.to].yaw_rad() - c.T_from_to.yaw_rad();
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(turn_rad).toRotationMatrix();
    const Eigen::Matrix2d position = c.covariance.matrix().topLeftCorner<2, 2>();
    information += R * position.inverse() * R.transpose();
  }
  return information;
}

bool ClosureGroups::is_conclusive(std::span<const std::size_t> set, const PoseGraph& graph) const {
  if (set.size() < tuning_.min_members) return false;
  const double first_m = chain_->path_m(waiting_[set.front()].closure.to);
  const double last_m = chain_->path_m(waiting_[set.back()].closure.to);
  if (last_m - first_m < multiscan_length_m_) return false;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  for (const std::size_t i : set) {
    solver.computeDirect(information_without(i, set, graph), Eigen::EigenvaluesOnly);
    if (solver.eigenvalues()(0) * tuning_.max_sigma_m * tuning_.max_sigma_m < 1.0) return false;
  }
  return static_cast<double>(largest_rival(set)) <= tuning_.max_rival_share * static_cast<double>(set.size());
}

std::vector<LoopClosure> ClosureGroups::add(std::span<const LoopClosure> found, const PoseGraph& graph) {
  std::vector<LoopClosure> accepted;
  if (found.empty()) return accepted;
  const KeyframeId query = found.front().to;
  forget_before(chain_->path_m(query) - tuning_.reach_m);
  const IdMap<KeyframeId, Eigen::Matrix3d> covariances =
      relative_covariances(graph, query, covariance_tuning_);
  const std::size_t first_new = waiting_.size();
  for (const LoopClosure& closure : found) admit(closure, graph, covariances);
  std::vector<std::size_t> largest;
  for (std::size_t i = first_new; i < waiting_.size(); ++i) {
    std::vector<std::size_t> set = agreeing_set(i);
    if (set.size() > largest.size()) largest = std::move(set);
  }
  if (!is_conclusive(largest, graph)) return accepted;
  for (const std::size_t i : largest) accepted.push_back(waiting_[i].closure);
  waiting_.clear();
  return accepted;
}

}  // namespace swiftlet

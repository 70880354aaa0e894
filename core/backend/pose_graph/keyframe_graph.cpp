// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/keyframe_graph.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "core/backend/pose_graph/relative_uncertainty.hpp"
#include "core/geometry/pose_residual.hpp"
#include "core/sensing/odometry_covariance.hpp"

namespace swiftlet {
namespace {

/// Chi-square a factor.
double misfit(std::span<const RelativePoseFactor<KeyframeId>> group, const KeyframePoses& T_map_keyframe) {
  double sum = 0.0;
  for (const RelativePoseFactor<KeyframeId>& factor : group) sum += chi_square(factor, T_map_keyframe);
  return sum / static_cast<double>(group.size());
}

/// Moves the poses from `since` on as a whole to where the closure is satisfied. Solving from where they are
/// fails where that is about half a turn away.
void move_since(KeyframeId since, const RelativePoseFactor<KeyframeId>& closure,
                KeyframePoses& T_map_keyframe) {
  const Pose2 T_map_to = T_map_keyframe[closure.from] * closure.T_from_to;
  const Pose2 T_moved = T_map_to * T_map_keyframe[closure.to].inverse();
  for (auto k = T_map_keyframe.at_or_after(since); k < T_map_keyframe.end_id(); k = T_map_keyframe.next(k))
    T_map_keyframe[k] = T_moved * T_map_keyframe[k];
}

bool is_unknown(const RelativePoseFactor<KeyframeId>& motion) {
  return motion.information == kUnknownMotion.information().asDiagonal().toDenseMatrix();
}

}  // namespace

KeyframeGraph::KeyframeGraph(const BackendConfig& config, const KeyframeChain& chain)
    : config_(&config),
      chain_(&chain),
      optimizer_(config.dcs_phi, config.optimizer_iterations),
      building_axis_prior_(config.tuning.axis) {}

void KeyframeGraph::add_keyframe(const Keyframe& made, const KeyframePoses& T_local_keyframe) {
  const auto steps = static_cast<std::uint32_t>(made.T_local_keyframe.size() - 1);
  for (KeyframeId id = made.id - steps; id < made.id; ++id) {
    if (const std::optional<FactorId> step = motion_factor_[id])
      graph_.factors[*step].T_from_to = between(T_local_keyframe[id - 1], T_local_keyframe[id]);
  }
  add_motion(made, T_local_keyframe);
  predict_new_poses();
}

void KeyframeGraph::add_motion(const Keyframe& made, const KeyframePoses& T_local_keyframe) {
  graph_.T_map_keyframe.push_back(T_local_keyframe[made.id]);
  motion_factor_.push_back({});
  if (made.id == T_local_keyframe.first_id()) return;
  RelativePoseFactor<KeyframeId> step;
  step.from = T_local_keyframe.previous(made.id);
  step.to = made.id;
  step.T_from_to = between(T_local_keyframe[step.from], T_local_keyframe[step.to]);
  const bool has_restarted = made.starts_segment && !made.odometry_ran_on;
  step.information = has_restarted ? kUnknownMotion.information().asDiagonal().toDenseMatrix()
                                   : residual_information(step.T_from_to, made.motion_covariance.matrix());
  motion_factor_[made.id] = graph_.factors.push_back(step);
  if (!has_restarted) return;
  step.information = kStoodStill.information().asDiagonal();
  step.is_closure = true;
  graph_.factors.push_back(step);
}

void KeyframeGraph::doubt_motion_to(KeyframeId keyframe) {
  RelativePoseFactor<KeyframeId>& motion = motion_to(keyframe);
  RelativePoseFactor<KeyframeId> as_measured = motion;
  if (is_unknown(motion)) return;
  motion.information = kUnknownMotion.information().asDiagonal();
  as_measured.is_closure = true;
  graph_.doubted.push_back(graph_.factors.push_back(as_measured));
}

/// Farther back than what counts as older map there is none: what was flown since would be that map itself.
KeyframeId KeyframeGraph::most_bent_before(KeyframeId last) const {
  const double first_m = chain_->path_m(last) - config_->tuning.confidence.old_after_m;
  KeyframeId bent = last;
  double most = 0.0;
  for (KeyframeId k = chain_->all().previous(last);
       k > chain_->all().first_id() && chain_->path_m(k) > first_m; k = chain_->all().previous(k)) {
    const double strain = chi_square(motion_to(k), graph_.T_map_keyframe);
    if (strain <= most || is_unknown(motion_to(k))) continue;
    most = strain;
    bent = k;
  }
  return bent;
}

/// `released`: solved with this motion free in place of the doubted one.
bool KeyframeGraph::is_better_without(KeyframeId bent, FactorId doubted, PoseGraph& released) {
  PoseGraph as_it_is = graph_;
  released = graph_;
  RelativePoseFactor<KeyframeId>& in_doubt = released.factors[doubted];
  RelativePoseFactor<KeyframeId>& motion = released.factors[*motion_factor_[bent]];
  released.factors[*motion_factor_[in_doubt.to]].information = in_doubt.information;
  in_doubt = motion;
  in_doubt.is_closure = true;
  in_doubt.information.setZero();
  motion.information = kUnknownMotion.information().asDiagonal();
  const OptimizeEffort effort{tuning().live_step, config_->optimizer_iterations};
  const Result<OptimizeReport> before = optimizer_.optimize(as_it_is, effort);
  const Result<OptimizeReport> after = optimizer_.optimize(released, effort);
  counters_.solver_failures += static_cast<std::uint64_t>(!before || !after);
  return before && after &&
         0.5 * (before->chi_square - after->chi_square) > config_->tuning.confidence.alarm_log_odds;
}

bool KeyframeGraph::release_bent_motion() {
  PoseGraph released;
  for (const FactorId id : graph_.doubted) {
    const RelativePoseFactor<KeyframeId>& doubted = graph_.factors[id];
    if (doubted.information.isZero(0.0)) continue;  // released already
    const KeyframeId bent = most_bent_before(doubted.to);
    const double strain = chi_square(motion_to(bent), graph_.T_map_keyframe);
    if (bent == doubted.to || strain < tuning().expected_chi_square ||
        strain < chi_square(doubted, graph_.T_map_keyframe) || !is_better_without(bent, id, released))
      continue;
    graph_ = std::move(released);
    state_ = GraphState::kMoved;
    return true;
  }
  return false;
}

void KeyframeGraph::predict_new_poses() {
  KeyframePoses& T_map = graph_.T_map_keyframe;
  for (KeyframeId k = T_map.next(optimized_upto_); k < T_map.end_id(); k = T_map.next(k))
    T_map[k] = T_map[T_map.previous(k)] * motion_to(k).T_from_to;
}

/// Uncertainty of the heading from one keyframe to a later one by motion alone, or, where motion loses it, by
/// the whole graph: closures may have recovered it.
double KeyframeGraph::yaw_variance_rad2(KeyframeId from, KeyframeId to) const {
  double variance_rad2 = 0.0;
  for (KeyframeId k = from; k != to;) {
    k = motion_factor_.next(k);
    variance_rad2 += motion_to(k).information.inverse()(2, 2);
  }
  const double lost_rad = tuning().lost_heading_rad;
  if (variance_rad2 < lost_rad * lost_rad) return variance_rad2;
  return relative_covariances(graph_, from, config_->tuning.covariance)[to](2, 2);
}

void KeyframeGraph::observe_building_axis(const FrontendEstimates& estimates) {
  const KeyframeId newest = graph_.T_map_keyframe.last_id();
  const double here_m = chain_->path_m(newest);
  if (!config_->align_to_walls ||
      here_m - axis_observed_at_m_ < tuning().axis_every_share * config_->submap_length_m)
    return;
  axis_observed_at_m_ = here_m;
  const std::optional<WallAxis> axis =
      estimates.wall_axis_around_newest(*chain_, config_->submap_length_m, config_->tuning.walls);
  if (!axis) return;
  const std::size_t before = graph_.headings.size();
  const double variance_rad2 = before == 0 ? 0.0 : yaw_variance_rad2(graph_.headings.back().pose, newest);
  building_axis_prior_.add(newest, *axis, variance_rad2, graph_);
  has_new_heading_ = graph_.headings.size() > before;
}

FactorId KeyframeGraph::add_closure(const RelativePoseFactor<KeyframeId>& closure) {
  return new_closures_.emplace_back(graph_.factors.push_back(closure));
}

bool KeyframeGraph::accommodate(std::span<const RelativePoseFactor<KeyframeId>> group, KeyframeId since) {
  if (misfit(group, graph_.T_map_keyframe) <= tuning().max_misfit) return true;
  building_axis_prior_.update(graph_);
  PoseGraph trial = graph_;
  move_since(since, group.back(), trial.T_map_keyframe);
  for (RelativePoseFactor<KeyframeId> factor : group) {
    factor.is_closure = false;
    trial.factors.push_back(factor);
  }
  if (!optimizer_.optimize(trial, {tuning().live_step, config_->optimizer_iterations})) {
    ++counters_.solver_failures;
    return false;
  }
  if (misfit(group, trial.T_map_keyframe) > tuning().max_misfit) return false;
  graph_.T_map_keyframe = std::move(trial.T_map_keyframe);
  state_ = GraphState::kMoved;
  return true;
}

void KeyframeGraph::disable(FactorId factor) {
  graph_.factors[factor].information.setZero();
  if (state_ != GraphState::kMoved) state_ = GraphState::kConverging;
}

bool KeyframeGraph::settle() {
  const bool due = is_due();
  new_closures_.clear();
  has_new_heading_ = false;
  return due && optimize({tuning().live_step, tuning().live_iterations});
}

/// Whether the last solution is still on its way, what is new disagrees with the graph, or something that
/// does not has waited long enough.
bool KeyframeGraph::is_due() {
  if (state_ == GraphState::kSettled && (has_new_heading_ || !new_closures_.empty()))
    state_ = GraphState::kPending;
  if (state_ != GraphState::kPending) return state_ != GraphState::kSettled;
  if (graph_.T_map_keyframe.last_id() - optimized_upto_ >= tuning().max_keyframes_waiting) return true;
  if (has_new_heading_) {
    building_axis_prior_.update(graph_);
    if (chi_square(graph_.headings.back(), graph_.T_map_keyframe) > tuning().expected_chi_square) return true;
  }
  return std::any_of(new_closures_.begin(), new_closures_.end(), [&](FactorId id) {
    return chi_square(graph_.factors[id], graph_.T_map_keyframe) > tuning().expected_chi_square;
  });
}

bool KeyframeGraph::optimize(const OptimizeEffort& effort) {
  ++counters_.optimizations;
  const bool was_moved = state_ == GraphState::kMoved;
  building_axis_prior_.update(graph_);
  const Result<OptimizeReport> report = optimizer_.optimize(graph_, effort);
  state_ = report && !report->converged ? GraphState::kConverging : GraphState::kSettled;
  if (!report) {
    ++counters_.solver_failures;
    return was_moved;
  }
  optimized_upto_ = graph_.T_map_keyframe.last_id();
  return true;
}

void KeyframeGraph::erase(const IdRanges<KeyframeId>& pruned,
                          std::span<const RelativePoseFactor<KeyframeId>> ties) {
  for (const RelativePoseFactor<KeyframeId>& tie : ties) graph_.factors.push_back(tie);
  graph_.factors.erase_if([&](const RelativePoseFactor<KeyframeId>& factor) {
    return pruned.contains(factor.from) || pruned.contains(factor.to);
  });
  std::erase_if(graph_.doubted, [&](FactorId id) { return !graph_.factors.contains(id); });
  building_axis_prior_.erase(pruned, graph_);
  motion_factor_.erase(pruned);
  graph_.T_map_keyframe.erase(pruned);
  optimized_upto_ = graph_.T_map_keyframe.at_or_after(optimized_upto_);
  join_across_holes();
}

void KeyframeGraph::join_across_holes() {
  const KeyframePoses& T_map = graph_.T_map_keyframe;
  for (std::size_t k = 1; k < motion_factor_.size(); ++k) {
    std::optional<FactorId>& joined = motion_factor_.values()[k];
    if (graph_.factors.contains(*joined)) continue;
    RelativePoseFactor<KeyframeId> unknown;
    unknown.from = T_map.id_at(k - 1);
    unknown.to = T_map.id_at(k);
    unknown.T_from_to = between(T_map[unknown.from], T_map[unknown.to]);
    unknown.information = kUnknownMotion.information().asDiagonal();
    joined = graph_.factors.push_back(unknown);
  }
}

}  // namespace swiftlet

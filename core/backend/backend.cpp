// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/backend.hpp"

#include "core/backend/loop_closing/loop_closer.hpp"
#include "core/backend/pose_graph/keyframe_graph.hpp"
#include "core/backend/refinement/run_refinement.hpp"

namespace swiftlet {

struct Backend::State {
  State(const BackendConfig& backend_config, const SensorModel& sensor, const BeamLayout& beams)
      : config(backend_config), scans(beams), refinement(config, sensor, scans, chain) {}

  [[nodiscard]] const KeyframePoses& T_local_keyframe() const { return estimates.T_local_keyframe(); }
  [[nodiscard]] const KeyframePoses& T_map_keyframe() const { return graph.T_map_keyframe(); }
  bool follow_graph(bool has_moved);
  ScanRange refine_window(const BackendUpdate& update);

  BackendConfig config;
  ScanStore scans;
  KeyframeChain chain{scans};
  FrontendEstimates estimates;
  KeyframeGraph graph{config, chain};
  LoopCloser loops{config, scans, chain};
  RunRefinement refinement;
  Pruner pruner{config, scans, chain};
  std::uint32_t version = 0;  // counts up whenever earlier keyframes have moved
  std::uint64_t scans_pruned = 0;
};

bool Backend::State::follow_graph(bool has_moved) {
  if (!has_moved) return false;
  ++version;
  loops.take_scales(graph.graph());
  return true;
}

/// Around the newest keyframe or elsewhere.
ScanRange Backend::State::refine_window(const BackendUpdate& update) {
  if (update.poses_changed) refinement.follow(T_map_keyframe());
  for (const LoopClosure& closure : loops.closures().values().last(update.new_closures))
    refinement.queue_around(closure.from);
  const ScanRange refined = refinement.refine_window(T_map_keyframe(), T_local_keyframe());
  if (!refined.empty()) ++version;
  return refined;
}

Backend::Backend(const BackendConfig& config, const SensorModel& sensor, const BeamLayout& beams) {
  SWIFTLET_CHECK(config.validate().empty(), "the backend's configuration is valid");
  state_ = std::make_unique<State>(config, sensor, beams);
}
Backend::~Backend() = default;

BackendUpdate Backend::add(const FrontendStep& step) {
  State& s = *state_;
  const ScanId scan = s.scans.add(step);
  s.refinement.add_scan();
  BackendUpdate update;
  if (!step.has_keyframe) {
    s.loops.search_elsewhere(s.T_local_keyframe(), s.graph.graph());
    return update;
  }
  SWIFTLET_CHECK(s.chain.add(scan) == step.made.id, "no keyframe is left out");
  s.estimates.take(step.made);
  s.graph.add_keyframe(step.made, s.T_local_keyframe());
  s.loops.add_keyframe(step.made, s.T_local_keyframe());
  s.graph.observe_building_axis(s.estimates);
  update.new_closures = s.loops.close_loops(s.T_local_keyframe(), s.graph);
  update.poses_changed = s.follow_graph(s.graph.settle());
  update.refined = s.refine_window(update);
  return update;
}

BackendUpdate Backend::finish() {
  State& s = *state_;
  BackendUpdate update;
  if (!s.loops.closures().empty() || !s.graph.graph().headings.empty()) {
    update.poses_changed = s.follow_graph(s.graph.optimize());
    while (s.loops.drop_worst(s.graph) && s.follow_graph(s.graph.optimize())) {
    }
  }
  if (s.refinement.refine_all(s.graph.graph(), s.T_local_keyframe())) {
    update.poses_changed = true;
    ++s.version;
  }
  return update;
}

Pruning Backend::next_pruning() {
  State& s = *state_;
  return s.pruner.next(s.T_map_keyframe(), s.loops.open_since().value_or(s.chain.all().end_id()));
}

void Backend::prune(const Pruning& pruning) {
  State& s = *state_;
  if (pruning.empty()) return;
  SWIFTLET_CHECK(!s.refinement.is_final(), "the run goes on");
  s.graph.erase(pruning.keyframes,
                ties_around(pruning, s.scans, s.T_map_keyframe(), s.config.tuning.pruning));
  s.loops.erase(pruning.keyframes);
  s.estimates.erase(pruning.keyframes);
  s.pruner.keep_anchors(pruning);
  s.scans.erase(pruning.scans);
  s.chain.erase(pruning.keyframes);
  s.refinement.erase(pruning.scans, pruning.ids);
  s.scans_pruned += pruning.scan_count;
}

const ScanStore& Backend::scans() const { return state_->scans; }
const KeyframeChain& Backend::keyframes() const { return state_->chain; }
Pose2 Backend::T_map_keyframe(KeyframeId id) const { return T_map_body(state_->chain.scan_of(id)); }
Pose2 Backend::T_map_body(ScanId scan) const {
  return state_->refinement.T_map_body(scan, state_->T_map_keyframe());
}
MapCorrection Backend::correction() const {
  const State& s = *state_;
  if (s.chain.size() == 0) return {};
  const Pose2 T_map_newest = s.refinement.T_map_newest(s.T_map_keyframe(), s.T_local_keyframe());
  return {s.chain.all().last_id(), T_map_newest * s.T_local_keyframe().values().back().inverse(), s.version};
}
const IdMap<ClosureId, LoopClosure>& Backend::closures() const { return state_->loops.closures(); }
const std::vector<Wall>& Backend::walls() const { return state_->estimates.walls(); }

BackendCounters Backend::counters() const {
  const State& s = *state_;
  const RefinementCounters refinement = s.refinement.counters();
  return {.scans = index_of(s.scans.all().end_id()),
          .scans_pruned = s.scans_pruned,
          .keyframes = index_of(s.chain.all().end_id()),
          .submaps = s.loops.counters().submaps,
          .candidates_matched = s.loops.counters().candidates_matched,
          .closures_accepted = index_of(s.loops.closures().end_id()),
          .closures_dropped = s.loops.counters().closures_dropped,
          .optimizations = s.graph.counters().optimizations,
          .solver_failures = s.graph.counters().solver_failures + refinement.solver_failures,
          .windows_refined = refinement.windows_refined,
          .windows_refused = refinement.windows_refused,
          .refined = refinement.refined,
          .held_out_before_m = refinement.held_out_before_m,
          .held_out_after_m = refinement.held_out_after_m,
          .map_source = refinement.map_source};
}

}  // namespace swiftlet

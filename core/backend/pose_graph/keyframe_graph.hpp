// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/backend/config/backend_config.hpp"
#include "core/backend/pose_graph/building_axis_prior.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/pose_graph/pose_graph_optimizer.hpp"
#include "core/backend/store/frontend_estimates.hpp"

namespace swiftlet {

/// Whether the graph's poses are at rest.
enum class GraphState : std::uint8_t {
  kSettled,     ///< every factor took part in the last optimisation
  kPending,     ///< new factors, which the graph had expected, wait for others
  kConverging,  ///< the last optimisation was stopped before it had converged
  kMoved,       ///< the poses were moved to where a group of closures puts them, and not optimised since
};

struct KeyframeGraphCounters {
  std::uint64_t optimizations = 0;
  std::uint64_t solver_failures = 0;
};

/// The pose graph of the run: motion between keyframes, loop closures and headings by the building's axis,
/// optimised while it grows, in steps of bounded effort. One thread at a time; allocates.
class KeyframeGraph {
 public:
  /// Views the configuration and the chain, which must outlive it.
  KeyframeGraph(const BackendConfig& config, const KeyframeChain& chain);

  /// Adds the motion to the newest keyframe, and takes the frontend's new estimates of the last steps.
  void add_keyframe(const Keyframe& made, const KeyframePoses& T_local_keyframe);
  /// The motion to this keyframe may not be as it was measured: it counts under DCS from now on.
  void doubt_motion_to(KeyframeId keyframe);
  /// Doubt begins where a contradiction is seen, behind the motion that went wrong. Where closures bend one
  /// shortly before the doubted one, and all that is known fits better by as much as raises an alarm if it is
  /// free, that is the one: it is unknown from now on, the doubted one counts as measured again, and the
  /// poses have moved. Returns whether there was one. One at a time.
  bool release_bent_motion();
  /// Every few metres: the newest keyframe gets a heading by the axis of the walls around it.
  void observe_building_axis(const FrontendEstimates& estimates);
  FactorId add_closure(const RelativePoseFactor<KeyframeId>& closure);
  /// Whether a group of closures, not yet added, agrees with the graph. One that lies farther off than DCS
  /// lets closures pull may move the poses there first, beginning with those from `since` on where its last
  /// closure has them; where it does not fit against what else is known, they stay and the answer is false.
  /// Precondition: the group is not empty. With the end id as `since` none is moved beforehand.
  bool accommodate(std::span<const RelativePoseFactor<KeyframeId>> group, KeyframeId since);

  /// Once a keyframe, after everything was added: optimises if that is due. True: poses have moved.
  bool settle();
  /// Optimises until it converges. True: poses have moved.
  bool optimize() { return optimize({tuning().final_step}); }
  /// The factor no longer counts, from the next optimisation on.
  void disable(FactorId factor);
  /// Erases keyframes with their factors. The motion across each hole is unknown; `ties` hold its ends.
  void erase(const IdRanges<KeyframeId>& pruned, std::span<const RelativePoseFactor<KeyframeId>> ties);

  [[nodiscard]] const PoseGraph& graph() const { return graph_; }
  [[nodiscard]] const KeyframePoses& T_map_keyframe() const { return graph_.T_map_keyframe; }
  [[nodiscard]] GraphState state() const { return state_; }
  [[nodiscard]] const KeyframeGraphCounters& counters() const { return counters_; }

 private:
  [[nodiscard]] const RelativePoseFactor<KeyframeId>& motion_to(KeyframeId keyframe) const {
    return graph_.factors[*motion_factor_[keyframe]];
  }
  [[nodiscard]] RelativePoseFactor<KeyframeId>& motion_to(KeyframeId keyframe) {
    return graph_.factors[*motion_factor_[keyframe]];
  }
  [[nodiscard]] KeyframeId most_bent_before(KeyframeId last) const;
  [[nodiscard]] bool is_better_without(KeyframeId bent, FactorId doubted, PoseGraph& released);
  void add_motion(const Keyframe& made, const KeyframePoses& T_local_keyframe);
  void predict_new_poses();
  [[nodiscard]] double yaw_variance_rad2(KeyframeId from, KeyframeId to) const;
  [[nodiscard]] bool is_due();
  void join_across_holes();
  bool optimize(const OptimizeEffort& effort);
  [[nodiscard]] const KeyframeGraphTuning& tuning() const { return config_->tuning.graph; }

  const BackendConfig* config_;
  const KeyframeChain* chain_;
  PoseGraphOptimizer optimizer_;
  BuildingAxisPrior building_axis_prior_;
  PoseGraph graph_;
  IdMap<KeyframeId, std::optional<FactorId>> motion_factor_;  // that joins it to the one before
  GraphState state_ = GraphState::kSettled;
  KeyframeId optimized_upto_{};         // later keyframes hang on by their motion
  std::vector<FactorId> new_closures_;  // since the last settle()
  bool has_new_heading_ = false;        // likewise
  double axis_observed_at_m_ = 0.0;     // of travel
  KeyframeGraphCounters counters_;
};

}  // namespace swiftlet

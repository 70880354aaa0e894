// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/backend/refinement/traversal_index.hpp"
#include "core/backend/refinement/window_refinement.hpp"
#include "core/backend/store/keyframe_chain.hpp"
#include "core/backend/store/traversal.hpp"

namespace swiftlet {

/// Joint refinement while the run goes on, a layer upon the pose graph: each scan has an offset from where
/// the graph puts it, and keeps it when the graph moves. Each step refines the newest window, of bounded
/// size, against the walls of a bounded number of traversals nearby. Views scans and chain, which must
/// outlive it. Allocates. One thread at a time. Repeatable.
class OnlineRefinement {
 public:
  OnlineRefinement(const ScanStore& scans, const KeyframeChain& chain, const SensorModel& sensor,
                   const BackendTuning& tuning = {})
      : scans_(&scans),
        chain_(&chain),
        tuning_(tuning.online),
        refinement_tuning_(tuning.refinement),
        window_refinement_(scans, sensor.odometry, tuning.refinement),
        traversals_(tuning.index, tuning.refinement.walls.radius_m) {}

  /// The store has a new scan, which starts with its predecessor's offset.
  void add_scan();
  /// Follows the store and the chain, from which the same whole traversals were erased.
  void erase(const IdRanges<ScanId>& scans, const IdRanges<TraversalId>& traversals);
  /// The graph was optimised.
  void follow(const KeyframePoses& T_map_keyframe);
  /// After each keyframe: refines the newest scans. Takes the poses of all keyframes by the graph and by the
  /// frontend, whose steps are weakened where they are in doubt. Returns what moved. Errors: kSolver; nothing
  /// has moved then.
  Result<ScanRange> step(const KeyframePoses& T_map_keyframe, const KeyframePoses& T_local_keyframe,
                         std::span<const DoubtedMotion> doubted = {});

  /// Takes offsets of consecutive scans. Those behind them get that of the last one.
  void take_offsets(const ScanRange& scans, std::span<const Pose2> T_graph_refined,
                    const KeyframePoses& T_map_keyframe);
  [[nodiscard]] std::span<const Pose2> T_graph_refined(const ScanRange& scans) const {
    return T_graph_refined_.values(scans);
  }
  /// The refined pose of a scan that the graph puts there.
  [[nodiscard]] Pose2 refined(ScanId scan, const Pose2& T_map_graph) const {
    return T_map_graph * T_graph_refined_[scan];
  }
  /// What the last step was about.
  [[nodiscard]] const WindowReport& last_window() const { return last_window_; }
  [[nodiscard]] std::uint64_t windows_refined() const { return windows_refined_; }
  [[nodiscard]] std::uint64_t windows_refused() const { return windows_refused_; }

 private:
  [[nodiscard]] Pose2 T_map_body(ScanId scan, const KeyframePoses& T_map_keyframe) const;
  [[nodiscard]] TraversalId newest_traversal() const;
  [[nodiscard]] TraversalId before(TraversalId traversal) const;
  [[nodiscard]] ScanRange scans_of(TraversalId traversal) const {
    return chain_->scans_of(keyframes_of(traversal));
  }
  /// Of its beginning: what a traversal sees of another one is left out.
  [[nodiscard]] StoreyId storey(TraversalId traversal) const {
    return chain_->storey(keyframes_of(traversal).first);
  }
  [[nodiscard]] ScanRange newest_window() const;
  [[nodiscard]] WindowPoses poses_of(const ScanRange& window, const KeyframePoses& T_map_keyframe,
                                     const KeyframePoses& T_local_keyframe) const;
  [[nodiscard]] std::vector<TraversalPoint> walls_around(const ScanRange& window, const WindowPoses& poses,
                                                         const KeyframePoses& T_map_keyframe) const;
  void take(const ScanRange& window, const WindowPoses& poses, const KeyframePoses& T_map_keyframe);
  void file_anew(const ScanRange& range, const KeyframePoses& T_map_keyframe);
  void file_traversal(TraversalId traversal, const KeyframePoses& T_map_keyframe);

  const ScanStore* scans_;
  const KeyframeChain* chain_;
  OnlineRefinementTuning tuning_;
  RefinementTuning refinement_tuning_;
  WindowRefinement window_refinement_;
  TraversalIndex traversals_;  // all but the newest, which is not complete
  IdMap<ScanId, Pose2> T_graph_refined_;
  WindowReport last_window_;
  std::uint64_t windows_refined_ = 0;
  std::uint64_t windows_refused_ = 0;
};

}  // namespace swiftlet

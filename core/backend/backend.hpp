// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/backend/confidence/pose_confidence.hpp"
#include "core/backend/config/backend_config.hpp"
#include "core/backend/loop_closing/loop_closure.hpp"
#include "core/backend/pruning/pruning.hpp"
#include "core/backend/refinement/map_source.hpp"
#include "core/backend/refinement/other_path.hpp"
#include "core/backend/store/frontend_estimates.hpp"
#include "core/backend/store/keyframe_chain.hpp"
#include "core/backend/store/scan_store.hpp"
#include "core/sensing/keyframe.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

struct PoseGraph;

/// Carries the frontend's continuous frame into the map: T_map_body = T_map_local * T_local_body. Plain
/// struct: crosses threads through a LatestValue.
struct MapCorrection {
  KeyframeId keyframe{};  ///< the keyframe it was computed at
  Pose2 T_map_local;
  std::uint32_t version = 0;  ///< counts up whenever keyframes moved that were there before
};

struct BackendCounters {
  std::uint64_t scans = 0;
  std::uint64_t scans_pruned = 0;  ///< of those
  std::uint64_t keyframes = 0;
  std::uint64_t submaps = 0;
  std::uint64_t candidates_matched = 0;  ///< submaps searched
  std::uint64_t closures_accepted = 0;
  std::uint64_t closures_dropped = 0;
  std::uint64_t optimizations = 0;
  std::uint64_t solver_failures = 0;
  std::uint64_t windows_refined = 0;    ///< windows of the online refinement that were accepted
  std::uint64_t windows_refused = 0;    ///< ... that held-out returns refused
  std::uint64_t stretches_refined = 0;  ///< likewise, of newest stretches
  std::uint64_t stretches_refused = 0;
  bool refined = false;            ///< the batch refinement was accepted
  double held_out_before_m = 0.0;  ///< distance of held-out returns from walls, before it
  double held_out_after_m = 0.0;
  MapSource map_source = MapSource::kPoseGraph;  ///< what the final map follows
  double yaw_noise_factor = 1.0;                 ///< OtherPath's of what it follows
  double floor_cost = 0.0;  ///< FloorField::cost() of the floors found; 0 where all are taken as even
  /// Minus the log likelihood of the final map but for a constant, comparable between runs of one input
  /// that were not mapped again; nothing where no final pass has refined it.
  std::optional<double> misfit;
};

/// What one step did, for whoever publishes.
struct BackendUpdate {
  bool poses_changed = false;      ///< poses of earlier keyframes moved: the map must follow
  std::uint32_t new_closures = 0;  ///< the last of closures()
  ScanRange refined;               ///< scans that refinement moved, besides
};

/// Submaps, loop closing and the pose graph (Algorithm 3 of the IROS 2022 paper). The sequence of steps alone
/// decides the result. One thread at a time; may allocate; no clock, no I/O.
///
/// Whoever wants memory and time per step to stay bounded in known space asks for the next pruning after
/// each step, takes what it still needs of those scans, and has them pruned. Keyframes keep the frontend's
/// ids, which are consecutive from 0; scans are counted from 0. What is pruned leaves a hole.
class Backend {
 public:
  /// Precondition: config.validate() is empty.
  Backend(const BackendConfig& config, const SensorModel& sensor, const BeamLayout& beams);
  ~Backend();
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;

  /// Takes one frontend step; at keyframes looks for loops, optimises and refines one window.
  BackendUpdate add(const FrontendStep& step);
  /// What is to be pruned now; mostly empty, and always until there are config.max_scans scans. Precondition:
  /// not after finish().
  [[nodiscard]] Pruning next_pruning();
  /// Prunes it. Precondition: nothing was added since next_pruning().
  void prune(const Pruning& pruning);
  /// The final pass: last optimisation, false closures dropped, every scan's pose refined, or that of the one
  /// among `map_again`'s paths which explains the ranges better. It is called in this thread, and not where
  /// dead reckoning is the map. Nothing may be added afterwards.
  BackendUpdate finish(const MapAgain& map_again = {});
  /// Whether such paths may be found: the final pass refines, and no scan was pruned.
  [[nodiscard]] bool can_be_mapped_again() const;

  [[nodiscard]] const ScanStore& scans() const;
  [[nodiscard]] const KeyframeChain& keyframes() const;
  /// Precondition of this and the next: it was not pruned.
  [[nodiscard]] Pose2 T_map_keyframe(KeyframeId id) const;
  /// Corrected pose of any scan: between two keyframes the graph's correction is spread evenly, what
  /// refinement found for the scan comes on top; after finish() the scan's own.
  [[nodiscard]] Pose2 T_map_body(ScanId scan) const;
  /// Leads to the newest keyframe; with refinement, to where the last few put it on average.
  [[nodiscard]] MapCorrection correction() const;
  /// What the newest pose can be relied on for.
  [[nodiscard]] TrackingFigures tracking() const;
  /// The same with the covariances of the newest keyframe's pose. They are computed anew, in O(n log n) of
  /// keyframes, once a closure was accepted and every few metres; between, they are carried on. Precondition:
  /// there is a keyframe, and finish() was not called.
  [[nodiscard]] PoseConfidence confidence();
  /// The first scan of the travel whose place is in doubt: since an unwatched motion that no known ground has
  /// placed, or since what is seen began to contradict the older map. Nothing while the pose can be relied
  /// on, and without loop closing, which alone finds places.
  [[nodiscard]] std::optional<ScanId> doubted_since() const;
  [[nodiscard]] const IdMap<ClosureId, LoopClosure>& closures() const;
  [[nodiscard]] const std::vector<Wall>& walls() const;
  /// Of the keyframes that were not pruned. Refinement moves scans, not these poses.
  [[nodiscard]] const PoseGraph& pose_graph() const;
  [[nodiscard]] BackendCounters counters() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/backend/config/backend_config.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/refinement/batch_refinement.hpp"
#include "core/backend/refinement/floor_field.hpp"
#include "core/backend/refinement/map_source.hpp"
#include "core/backend/refinement/online_refinement.hpp"
#include "core/backend/refinement/other_path.hpp"
#include "core/backend/refinement/stretch_refinement.hpp"
#include "core/backend/store/keyframe_chain.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

struct RefinementCounters {
  std::uint64_t windows_refined = 0;
  std::uint64_t windows_refused = 0;
  std::uint64_t stretches_refined = 0;
  std::uint64_t stretches_refused = 0;
  std::uint64_t solver_failures = 0;
  bool refined = false;  ///< the batch refinement was accepted
  double held_out_before_m = 0.0;
  double held_out_after_m = 0.0;
  MapSource map_source = MapSource::kPoseGraph;
  double yaw_noise_factor = 1.0;  ///< of the path that it follows
  double floor_cost = 0.0;        ///< FloorFindings'; 0 where the floors are taken as even
  std::optional<double> misfit;   ///< of that map: RefinementReport's, of all traversals
};

/// The poses of all scans: between the graph's keyframes, refined window by window while the run goes on, and
/// all at once at its end. One thread at a time; allocates.
class RunRefinement {
 public:
  /// Views scans and chain, which must outlive it.
  RunRefinement(const BackendConfig& config, const SensorModel& sensor, const ScanStore& scans,
                const KeyframeChain& chain);

  [[nodiscard]] bool is_wanted() const { return config_->refine && config_->close_loops; }
  void add_scan() { online_.add_scan(); }
  /// The graph was optimised.
  void follow(const KeyframePoses& T_map_keyframe);
  /// After each keyframe: refines one window. Returns what has moved.
  ScanRange refine_window(const PoseGraph& graph, const KeyframePoses& T_local_keyframe);
  /// After each keyframe: takes what refining the newest stretch has found, and begins that where a loop has
  /// closed since it last began. True: poses have moved.
  bool refine_stretch(const PoseGraph& graph, bool has_closed);
  /// After each scan: a slice of refining the newest stretch, if that was begun.
  void continue_stretch();
  /// Gives every scan a pose of its own, for good. True: poses have moved. The graph's path is held against
  /// dead reckoning alone; where it loses, so is the frontend's. All are refined in the same way, walls and
  /// poses in turn; the one chosen then together. Dead reckoning is the map unless the ranges pay for how far
  /// a correction departs from it. `map_again`: asked for final paths, unless dead reckoning is the map; one
  /// of them becomes the map where it explains the run better. Then the floors are found, and with them
  /// `map_again` is asked once more.
  bool refine_all(const PoseGraph& graph, const KeyframePoses& T_local_keyframe, const MapAgain& map_again);
  void erase(const IdRanges<ScanId>& scans, const IdRanges<TraversalId>& traversals);

  [[nodiscard]] Pose2 T_map_body(ScanId scan, const KeyframePoses& T_map_keyframe) const;
  /// Where the newest keyframe lies as the last few see it, the frontend's path from them to it being good to
  /// a centimetre: each was refined by itself, and the published pose must not jump with every one.
  [[nodiscard]] Pose2 T_map_newest(const KeyframePoses& T_map_keyframe,
                                   const KeyframePoses& T_local_keyframe) const;
  /// Whether refine_all() has moved poses.
  [[nodiscard]] bool is_final() const { return !T_map_refined_.empty(); }
  [[nodiscard]] RefinementCounters counters() const;

 private:
  /// A path that the map may follow.
  struct Hypothesis {
    MapSource source{};
    std::vector<Pose2> T_map_body;
    RefinementReport report{};
    double yaw_noise_factor = 1.0;
    FloorFindings floor{};
  };
  [[nodiscard]] Hypothesis hypothesis(MapSource source, const PoseGraph& graph,
                                      const KeyframePoses& T_local_keyframe) const;
  /// What a hypothesis is refined by besides dead reckoning and walls.
  struct Known {
    std::vector<RelativePoseFactor<ScanId>> closures;
    std::vector<HeadingFactor<ScanId>> headings;
    std::vector<DoubtedMotion> doubted;
  };
  [[nodiscard]] Known known_of(const PoseGraph& graph, const ScanRange& range) const;
  [[nodiscard]] Known known_of(const Hypothesis& hypothesis, const PoseGraph& graph) const;
  [[nodiscard]] Known known_of_stretch(const PoseGraph& graph, const ScanRange& stretch) const;
  void add_ties(const PoseGraph& graph, const ScanRange& stretch, Known& known) const;
  [[nodiscard]] ScanRange newest_stretch() const;
  bool take_stretch(const KeyframePoses& T_map_keyframe);
  [[nodiscard]] BatchRefinement batch(const Hypothesis& hypothesis, const Known& known) const;
  bool try_refine(Hypothesis& hypothesis, const PoseGraph& graph);
  void complete(Hypothesis& hypothesis, const PoseGraph& graph);
  [[nodiscard]] bool is_likelier(const Hypothesis& hypothesis, const Hypothesis& simpler) const;
  [[nodiscard]] std::optional<Hypothesis> best_of_run(const PoseGraph& graph,
                                                      const KeyframePoses& T_local_keyframe);
  [[nodiscard]] double cost_of(const Hypothesis& path, const RefinementReport& judged) const;
  void take_better(std::span<const OtherPath> others, Hypothesis& best) const;
  [[nodiscard]] bool may_find_floor(const Hypothesis& best) const;
  bool find_floor(Hypothesis& best, const PoseGraph& graph);
  void take(Hypothesis best);

  const BackendConfig* config_;
  SensorModel sensor_;
  const ScanStore* scans_;
  const KeyframeChain* chain_;
  OnlineRefinement online_;
  StretchRefinement stretch_;
  bool has_closed_ = false;                // since a stretch was begun that was not given up ...
  std::optional<double> stretch_begun_m_;  // ... at this travel
  IdMap<ScanId, Pose2> T_map_refined_;     // by refine_all()
  RefinementCounters counters_;
};

}  // namespace swiftlet

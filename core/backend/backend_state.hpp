// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/backend/backend.hpp"
#include "core/backend/loop_closing/closure_groups.hpp"
#include "core/backend/loop_closing/loop_detector.hpp"
#include "core/backend/loop_closing/submap.hpp"
#include "core/backend/pose_graph/building_axis_prior.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/pose_graph/pose_graph_optimizer.hpp"
#include "core/backend/refinement/online_refinement.hpp"
#include "core/backend/store/keyframe_chain.hpp"

// What only the backend's own files may know.
namespace swiftlet {

/// Of a motion that nobody measured.
[[nodiscard]] inline Eigen::Matrix3d unknown_motion_information() {
  return Eigen::Vector3d(1e-4, 1e-4, 1e-1).asDiagonal();
}

struct Backend::State {
  State(const BackendConfig& backend_config, const SensorModel& sensor_model, const BeamLayout& beams)
      : config(backend_config),
        sensor(sensor_model),
        scans(beams),
        chain(scans),
        detector(config, scans, chain),
        groups(chain),
        optimizer(config.dcs_phi, config.optimizer_iterations),
        live(scans, chain, sensor),
        prunes_at(static_cast<std::size_t>(config.max_scans)) {}

  void take_estimates(const Keyframe& made);
  void add_motion(const Keyframe& made);
  void carry_new_poses();
  void take_walls(const Keyframe& made);
  void finish_submaps(KeyframeId newest);
  bool hold_heading(KeyframeId newest);
  [[nodiscard]] double yaw_variance_rad2(KeyframeId from, KeyframeId to) const;
  std::uint32_t close_loops(KeyframeId newest);
  void add_closure(LoopClosure closure);
  void believe(const std::vector<LoopClosure>& group);
  bool move_map_to(const std::vector<LoopClosure>& group);
  [[nodiscard]] bool is_due(bool turned, std::uint32_t new_closures, KeyframeId newest);
  bool optimize(const OptimizeEffort& effort = {});
  bool drop_false_closures();
  [[nodiscard]] bool refines() const { return config.refine && config.close_loops; }
  bool refine();
  void refine_online(BackendUpdate& update);
  [[nodiscard]] KeyframeId first_recent() const;
  void erase_factors(const IdRanges<KeyframeId>& keyframes);
  void join_across_holes();
  [[nodiscard]] const RelativePoseFactor<KeyframeId>& motion_to(KeyframeId keyframe) const {
    return graph.factors[*motion_factor[keyframe]];
  }
  [[nodiscard]] Pose2 T_map_body(ScanId scan) const;
  [[nodiscard]] Pose2 T_map_newest() const;

  BackendConfig config;
  SensorModel sensor;
  ScanStore scans;
  KeyframeChain chain;
  LoopDetector detector;
  ClosureGroups groups;
  BuildingAxisPrior building_axis_prior;
  KeyframeId heading_sought_at{};
  KeyframeId motion_known_since{};  // the first keyframe that the newest is joined to by measured motion
  PoseGraphOptimizer optimizer;
  OnlineRefinement live;

  std::vector<KeyframeId> anchors;  // of what was pruned: they stay
  KeyframePoses T_local_keyframe;
  PoseGraph graph;
  IdMap<ScanId, Pose2> T_map_refined;                        // of every scan, after finish(); empty before
  IdMap<KeyframeId, std::optional<FactorId>> motion_factor;  // that joins it to the one before
  bool news_waits = false;
  bool group_moved_map = false;          // since it was last optimised
  bool unsettled = false;                // when it was last optimised
  KeyframeId optimized_upto{};           // later keyframes hang on by their motion
  std::vector<KeyframeId> open_submaps;  // where the ones being travelled begin
  std::vector<std::shared_ptr<const Submap>> submaps;
  IdMap<ClosureId, LoopClosure> closures;
  std::vector<Wall> walls;
  std::uint32_t version = 0;
  std::size_t prunes_at = 0;  // that many scans
  BackendCounters counters;
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <vector>

#include "core/backend/config/backend_tuning.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/sensing/wall_axis.hpp"

namespace swiftlet {

/// Holds the heading by the walls: in most buildings they share one axis, and what a vehicle has seen of it
/// at its start tells it which way it flies hundreds of metres later. Dead reckoning by wheels loses degrees
/// with every metre; loops then end tens of metres from where they began. Like the heuristic drift
/// elimination of Borenstein & Ojeda 2010, in the pose graph, robust, and only where the walls do share an
/// axis: one that is farther from the building's than the heading can be wrong is left alone. One thread at a
/// time.
class BuildingAxisPrior {
 public:
  explicit BuildingAxisPrior(const BuildingAxisPriorTuning& tuning = {}) : tuning_(tuning) {}

  /// The walls around `keyframe` run along `axis`, in its frame; since the last heading in the graph its own
  /// became uncertain by `yaw_variance_rad2`. Adds a heading to the graph, or nothing where the axis is
  /// another one or may be a quarter turn off. Allocates.
  void add(KeyframeId keyframe, const WallAxis& axis, double yaw_variance_rad2, PoseGraph& graph);

  /// Erases the headings of these keyframes, here and in the graph.
  void erase(const IdRanges<KeyframeId>& pruned, PoseGraph& graph);
  /// Writes what the building's axis, as the graph now has it, makes of each heading in the graph.
  void update(PoseGraph& graph) const;

 private:
  [[nodiscard]] double building_axis_rad(const PoseGraph& graph) const;

  BuildingAxisPriorTuning tuning_;
  std::vector<WallAxis> axes_;  // in the frame of the keyframe of the graph's heading of the same index
};

}  // namespace swiftlet

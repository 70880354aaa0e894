// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <vector>

#include "core/backend/config/backend_tuning.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/sensing/wall_axis.hpp"

namespace swiftlet {

/// Constrains headings by the axis that the walls of most buildings share. Dead reckoning by wheels loses
/// degrees with every metre, and loops end tens of metres from where they began; the axis seen at the start
/// gives the heading hundreds of metres later. Similar to the heuristic drift elimination of Borenstein &
/// Ojeda 2010, but in the pose graph, robust, and only where walls share the axis: one that is farther from
/// the building's than the heading's uncertainty allows is ignored. One thread at a time.
class BuildingAxisPrior {
 public:
  explicit BuildingAxisPrior(const BuildingAxisPriorTuning& tuning = {}) : tuning_(tuning) {}

  /// `axis`: of the walls around `keyframe`, in its frame. `yaw_variance_rad2`: of its heading relative to
  /// that of the last heading factor. Adds a heading factor to the graph, or nothing where the axis is
  /// another one or may be a quarter turn off. Allocates.
  void add(KeyframeId keyframe, const WallAxis& axis, double yaw_variance_rad2, PoseGraph& graph);

  /// Erases the headings of these keyframes, here and in the graph.
  void erase(const IdRanges<KeyframeId>& pruned, PoseGraph& graph);
  /// Sets the yaw of each heading factor by the present estimate of the building's axis.
  void update(PoseGraph& graph) const;

 private:
  [[nodiscard]] double building_axis_rad(const PoseGraph& graph) const;

  BuildingAxisPriorTuning tuning_;
  std::vector<WallAxis> axes_;  // in the frame of the keyframe of the graph's heading of the same index
};

}  // namespace swiftlet

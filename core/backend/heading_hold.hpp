// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <vector>

#include "core/backend/pose_graph.hpp"
#include "core/sensing/wall_axis.hpp"

namespace swiftlet {

/// Holds the heading by the walls: in most buildings they share one axis, and what a vehicle has seen of it
/// at its start tells it which way it flies hundreds of metres later. Dead reckoning by wheels loses degrees
/// with every metre; loops then end tens of metres from where they began. Like the heuristic drift
/// elimination of Borenstein & Ojeda 2010, in the pose graph and robust. A building may have several axes,
/// for its wings: one that is farther from all known ones than the heading can be wrong, and is seen for long
/// enough, is another. One thread at a time.
class HeadingHold {
 public:
  /// The walls around `keyframe` run along `axis`, in its frame; since the last heading in the graph its own
  /// became uncertain by `yaw_variance_rad2`. Adds a heading to the graph, or several when an axis has become
  /// known, or nothing where it cannot tell which axis this is. Allocates.
  void add(KeyframeId keyframe, const WallAxis& axis, double yaw_variance_rad2, PoseGraph& graph);

  /// Writes what the building's axes, as the graph now has them, make of each heading in the graph.
  void update(PoseGraph& graph) const;

 private:
  struct Vote {
    KeyframeId keyframe{};
    WallAxis axis;  ///< in the keyframe's frame
  };
  struct Candidate;
  [[nodiscard]] double axis_map_rad(std::size_t axis, const PoseGraph& graph) const;
  [[nodiscard]] Candidate nearest_axis(const Vote& vote, const PoseGraph& graph) const;
  void take(const Vote& vote, std::size_t axis, PoseGraph& graph);
  void wait(const Vote& vote, PoseGraph& graph);

  std::vector<Vote> votes_;                            // of the graph's headings
  std::vector<std::size_t> axis_of_;                   // the axis that each of them belongs to
  std::vector<std::vector<std::size_t>> first_votes_;  // of each axis: indices of the votes that define it
  std::vector<Vote> waiting_;                          // that belonged to no axis, the last ones in a row
};

}  // namespace swiftlet

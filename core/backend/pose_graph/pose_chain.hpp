// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/base/result.hpp"

namespace swiftlet {

/// A PoseSystem of poses that are joined to their neighbours only: solved from one end to the other and back,
/// in time that grows with their number, without ordering or analysis. Allocates. One thread at a time.
class PoseChain {
 public:
  /// Begins a system of so many poses, the first of which is held. Precondition: pose_count >= 2.
  void reset(std::size_t pose_count);
  /// Adds a factor from a pose to the next one, at the present poses.
  void add(const RelativePoseFactor<PoseIndex>& step, const std::vector<Pose2>& T_map_pose);
  /// Adds to one pose alone: H of its block and -g.
  void add(PoseIndex pose, const Eigen::Matrix3d& H, const Eigen::Vector3d& rhs);
  /// Solves and moves the poses; what was added is used up. Errors: kSolver, also where the step is not
  /// finite; the poses are then as they were.
  Status step(std::vector<Pose2>& T_map_pose);

 private:
  struct Link {
    Eigen::Matrix3d H;         // of this pose
    Eigen::Matrix3d H_before;  // of this pose and the one before, rows are this one's
    Eigen::Vector3d rhs;
  };
  std::vector<Link> links_;  // of all poses but the first
};

}  // namespace swiftlet

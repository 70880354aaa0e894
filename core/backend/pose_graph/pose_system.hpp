// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/backend/pose_graph/cholmod_solver.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/base/result.hpp"

namespace swiftlet {

/// Moves all poses but the first by (x, y, yaw) each. Returns the largest component, in metres or radians.
/// Errors: kSolver where one is not finite; the poses are then as they were.
Result<double> move_poses(std::span<const double> steps, std::vector<Pose2>& T_map_pose);

/// Two poses that a factor joins.
struct PosePair {
  PoseIndex from{};
  PoseIndex to{};
};

/// One Gauss-Newton step over a list of poses, the first of which is held as gauge: gathers the normal
/// equations of factors and of anything else that pulls at a pose, and solves them. The symbolic analysis
/// is kept while the factors join the same pairs. Allocates. One thread at a time.
class PoseSystem {
 public:
  /// Sets up for `pose_count` poses joined by these factors. Precondition: pose_count >= 2. Errors:
  /// kSolver.
  Status prepare(std::size_t pose_count, std::span<const RelativePoseFactor<PoseIndex>> factors);
  /// The same for poses joined like this; pairs may repeat.
  Status prepare_pairs(std::size_t pose_count, std::span<const PosePair> pairs);

  void set_zero() { system_.set_zero(); }
  /// Adds a factor at the present poses, its information times `weight`.
  void add(const RelativePoseFactor<PoseIndex>& factor, double weight, const std::vector<Pose2>& T_map_pose);
  void add(const HeadingFactor<PoseIndex>& factor, double weight, const std::vector<Pose2>& T_map_pose);
  /// Adds to one pose alone: H of its block and -g.
  void add(PoseIndex pose, const Eigen::Matrix3d& H, const Eigen::Vector3d& rhs);
  /// Adds to the block of two poses that are joined, rows of `a`, columns of `b`.
  void add(PoseIndex a, PoseIndex b, const Eigen::Matrix3d& H_ab);

  /// Solves and moves the poses. Returns the largest component of the step, in metres or radians. Errors:
  /// kSolver, also where the step is not finite; the poses are then as they were.
  Result<double> step(std::vector<Pose2>& T_map_pose);

 private:
  BlockSystem3 system_{0, {}, kFirstFree};  // block b is pose b + 1
  CholmodSolver solver_;
  std::vector<BlockSystem3::BlockIndex> analyzed_pattern_;
  std::size_t analyzed_poses_ = 0;
  static constexpr std::uint32_t kFirstFree = 1;
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/backend/config/backend_tuning.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/systematic_motion.hpp"

namespace swiftlet {

/// Variances of a step of dead reckoning: of either coordinate, and of yaw.
struct StepVariance {
  double xy_m2 = 0.0;
  double yaw_rad2 = 0.0;
};

/// A pose in the frame of a node, and its derivative with respect to the systematic errors.
struct PoseInNode {
  Pose2 T_node_body;
  Eigen::Matrix<double, 3, kSystematicErrors> by_errors = Eigen::Matrix<double, 3, kSystematicErrors>::Zero();
};

/// Where a node lies, in the frame in which dead reckoning predicts it, and the derivative of that.
struct NodeError {
  Eigen::Vector3d error;
  Eigen::Matrix<double, 3, kSystematicErrors> by_errors;
};
/// `predicted`: RigidNodes::next(). `moved`: the node in the frame of the one before.
[[nodiscard]] NodeError node_error(const PoseInNode& predicted, const Pose2& moved);

/// A run as a chain of nodes: consecutive scans, a few tenths of a metre, whose dead reckoning less its
/// systematic errors is taken as it is. The frame of a node is the body frame of its first scan. A step that
/// was not measured (SystematicMotion::is_known()) has no systematic errors, and a node begins after it.
class RigidNodes {
 public:
  /// `variance_to`: of the step to each scan; the first counts for nothing. Allocates here and in blended().
  RigidNodes(std::vector<TimedOdometry> scans, std::vector<StepVariance> variance_to,
             const RigidNodesTuning& tuning);

  /// Places the scans in their nodes, and the nodes to each other, by dead reckoning less these errors.
  void reckon(const SystematicErrors& errors);

  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] std::size_t scans() const { return node_of_.size(); }
  [[nodiscard]] std::size_t node_of(std::size_t scan) const { return node_of_[scan]; }
  [[nodiscard]] std::size_t first_scan(std::size_t node) const { return nodes_[node].first; }
  [[nodiscard]] const PoseInNode& in_node(std::size_t scan) const { return in_node_[scan]; }
  /// The frame of the next node by dead reckoning.
  [[nodiscard]] const PoseInNode& next(std::size_t node) const { return nodes_[node].next; }
  /// Of the motion from the node before.
  [[nodiscard]] const StepVariance& variance_to(std::size_t node) const { return nodes_[node].variance_to; }
  /// The step to a scan less the errors; not the first.
  [[nodiscard]] const Pose2& step_to(std::size_t scan) const { return steps_[scan]; }
  [[nodiscard]] bool shows_time_offset() const { return motion_.shows_time_offset(); }

  /// The poses of all scans. Between the middles of two nodes, both place a scan by dead reckoning, and it
  /// lies between by the variance from either: the mean of a random walk whose ends are known.
  [[nodiscard]] std::vector<Pose2> blended(std::span<const Pose2> T_map_node) const;

 private:
  struct Node {
    std::size_t first = 0;
    StepVariance variance_to;
    PoseInNode next;
  };
  void divide(std::span<const TimedOdometry> scans, const RigidNodesTuning& tuning);
  [[nodiscard]] double middle_m2(std::size_t node) const;

  SystematicMotion motion_;
  std::vector<StepVariance> variance_to_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> node_of_;  // of each scan
  std::vector<PoseInNode> in_node_;     // each scan
  std::vector<Pose2> steps_;            // to each scan
  std::vector<double> reckoned_m2_;     // variance of either coordinate from the first scan to each
};

}  // namespace swiftlet

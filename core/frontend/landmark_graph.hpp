// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/fixed_vector.hpp"
#include "core/base/ids.hpp"
#include "core/frontend/landmark_factors.hpp"
#include "core/frontend/line_extractor.hpp"
#include "core/geometry/line2.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/odometry_covariance.hpp"

namespace swiftlet {

/// How much a landmark graph can hold.
struct LandmarkGraphCapacity {
  std::size_t poses = 0;
  std::size_t landmarks = 0;
  std::size_t observations = 0;
};

/// A keyframe's pose and the measured motion to it from the one before (unused in the oldest, which is the
/// gauge).
struct PoseVertex {
  KeyframeId id{};
  Pose2 T_local_body;
  Pose2 T_previous_body;                                  ///< measured
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of motion_residual()
};

/// What poses that have left the window knew about a wall.
struct LinePrior {
  Line2 mean_local;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  bool has_extent = false;
  Point2 start_local;
  Point2 end_local;
};

/// A wall.
struct Landmark {
  LandmarkId id{};
  Line2 line_local;  ///< not normalized: rho may go through 0 while it is estimated
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of line_local, the poses taken as known
  Point2 start_local;
  Point2 end_local;
  Point2 seen_from_local;  ///< where the vehicle last saw it from: tells its two faces apart
  KeyframeId last_seen{};
  std::size_t observation_count = 0;  ///< in the window
  LinePrior prior;
};

struct LineObservation {
  std::size_t pose = 0;      ///< index in poses()
  std::size_t landmark = 0;  ///< index in landmarks()
  Line2 line_body;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Point2 start_body;
  Point2 end_body;
};

/// Poses, walls and what ties them together over a fixed lag (eq. 9 of "Efficient 2D Graph SLAM for Sparse
/// Sensing", Zhou, Hu, Liu, Khan; IROS 2022). Other than the paper's, whose graph grows until a loop closes,
/// it forgets its oldest pose and keeps what that pose knew of the walls as a prior on each. What does not
/// fit is refused by the verb's return value; nothing grows or allocates. One thread at a time.
template <LandmarkGraphCapacity kCapacity>
class LandmarkGraph {
 public:
  static constexpr LandmarkGraphCapacity capacity() { return kCapacity; }

  [[nodiscard]] std::span<const PoseVertex> poses() const { return {poses_.data(), poses_.size()}; }
  [[nodiscard]] std::span<const Landmark> landmarks() const { return {landmarks_.data(), landmarks_.size()}; }
  [[nodiscard]] std::span<const LineObservation> observations() const {
    return {observations_.data(), observations_.size()};
  }
  /// Estimates only; the solver's.
  [[nodiscard]] std::span<PoseVertex> poses() { return {poses_.data(), poses_.size()}; }
  [[nodiscard]] std::span<Landmark> landmarks() { return {landmarks_.data(), landmarks_.size()}; }

  /// Appends a keyframe, placed by `motion` from the newest pose. False when full.
  [[nodiscard]] bool try_add_pose(KeyframeId id, const UncertainMotion& motion);
  /// Appends the first keyframe, the gauge. Precondition: the graph is empty.
  void add_first_pose(KeyframeId id, const Pose2& T_local_body);
  /// A new wall as the newest pose sees it, with that observation. False when either does not fit.
  [[nodiscard]] bool try_add_landmark(LandmarkId id, const LineSegment& segment);
  /// The newest pose sees a known wall. False when full.
  [[nodiscard]] bool try_observe(std::size_t landmark, const LineSegment& segment);
  /// What is known of the direction of the newest wall, which has no prior yet, before anything was seen of
  /// it.
  void hold_direction_of_newest(double alpha_local_rad, double information);

  /// Folds what the oldest pose knows into the walls' priors and makes the next pose the gauge; walls that no
  /// pose in the window sees any more are dropped. Returns how many. Precondition: more than one pose.
  std::size_t retire_oldest_pose();
  /// Algorithm 2: the end points of every wall from all its observations and its prior.
  void update_end_points();

  /// F(X) of eq. (9) at the present estimates.
  [[nodiscard]] double chi_square() const;

  /// Estimates and sizes to go back to: lines 7 and 12 of Algorithm 1.
  class Checkpoint {
    friend class LandmarkGraph;
    FixedVector<PoseVertex, kCapacity.poses> poses_;
    FixedVector<Landmark, kCapacity.landmarks> landmarks_;
    std::size_t observations_ = 0;
  };
  void save(Checkpoint& checkpoint) const;
  /// Precondition: since save() things were added and estimates changed, but nothing was retired.
  void restore(const Checkpoint& checkpoint);

 private:
  void fold(const LineObservation& observation, const Pose2& T_local_body);
  std::size_t drop_unseen_landmarks();
  static void extend_prior(LinePrior& prior, const Line2& line, const Point2& start, const Point2& end);

  FixedVector<PoseVertex, kCapacity.poses> poses_;
  FixedVector<Landmark, kCapacity.landmarks> landmarks_;
  FixedVector<LineObservation, kCapacity.observations> observations_;  // in the order of their poses
};

}  // namespace swiftlet

#include "core/frontend/landmark_graph_impl.hpp"

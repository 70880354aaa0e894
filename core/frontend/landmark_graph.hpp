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

/// Capacity of a landmark graph.
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
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of pose_residual()
};

/// What poses that have left the window contributed to a landmark.
struct LandmarkPrior {
  Line2 mean_local;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  bool has_extent = false;
  Point2 start_local;
  Point2 end_local;
};

/// A line of the graph: a wall, or one of its two faces.
struct Landmark {
  LandmarkId id{};
  Line2 line_local;  ///< not normalized: rho may go through 0 while it is estimated
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of line_local, the poses taken as known
  Point2 start_local;
  Point2 end_local;
  Point2 seen_from_local;  ///< where it was last observed from: distinguishes its two faces
  KeyframeId last_seen{};
  std::size_t observation_count = 0;  ///< in the window
  LandmarkPrior prior;
};

struct LineObservation {
  std::size_t pose = 0;      ///< index in poses()
  std::size_t landmark = 0;  ///< index in landmarks()
  Line2 line_body;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Point2 start_body;
  Point2 end_body;
};

/// Poses, landmarks and the factors between them over a fixed lag (eq. 9 of "Efficient 2D Graph SLAM for
/// Sparse Sensing", Zhou, Hu, Liu, Khan; IROS 2022). Unlike the paper's, whose graph grows until a loop
/// closes, it removes its oldest pose and keeps that pose's observations as a prior on each landmark. The
/// try_ functions return false where there is no room; nothing grows or allocates. One thread at a time.
template <LandmarkGraphCapacity kCapacity>
class LandmarkGraph {
 public:
  static constexpr LandmarkGraphCapacity capacity() { return kCapacity; }

  [[nodiscard]] std::span<const PoseVertex> poses() const { return {poses_.data(), poses_.size()}; }
  [[nodiscard]] std::span<const Landmark> landmarks() const { return {landmarks_.data(), landmarks_.size()}; }
  [[nodiscard]] std::span<const LineObservation> observations() const {
    return {observations_.data(), observations_.size()};
  }
  /// For the solver, which changes the estimates only.
  [[nodiscard]] std::span<PoseVertex> poses() { return {poses_.data(), poses_.size()}; }
  [[nodiscard]] std::span<Landmark> landmarks() { return {landmarks_.data(), landmarks_.size()}; }

  /// Appends a keyframe, placed by `motion` from the newest pose. False when full.
  [[nodiscard]] bool try_add_pose(KeyframeId id, const UncertainMotion& motion);
  /// Appends the first keyframe, the gauge. Precondition: the graph is empty.
  void add_first_pose(KeyframeId id, const Pose2& T_local_body);
  /// A new landmark, as observed by the newest pose, with that observation. False when either does not fit.
  [[nodiscard]] bool try_add_landmark(LandmarkId id, const LineSegment& segment);
  /// The newest pose observes a landmark again. False when full.
  [[nodiscard]] bool try_observe(std::size_t landmark, const LineSegment& segment);
  /// A prior on the direction of the newest landmark, which has none yet.
  void add_direction_prior_to_newest(double alpha_local_rad, double information);

  /// Folds the oldest pose's observations into the landmarks' priors and makes the next pose the gauge; drops
  /// landmarks without an observation in the window. Returns how many. Precondition: more than one pose.
  std::size_t marginalize_oldest_pose();
  /// Algorithm 2: the end points of each landmark from all its observations and its prior.
  void update_end_points();

  /// F(X) of eq. (9) at the present estimates.
  [[nodiscard]] double chi_square() const;

  /// Estimates and sizes for a rollback: lines 7 and 12 of Algorithm 1.
  class Checkpoint {
    friend class LandmarkGraph;
    FixedVector<PoseVertex, kCapacity.poses> poses_;
    FixedVector<Landmark, kCapacity.landmarks> landmarks_;
    std::size_t observations_ = 0;
  };
  void save(Checkpoint& checkpoint) const;
  /// Precondition: since save() nothing was removed.
  void restore(const Checkpoint& checkpoint);

 private:
  void fold(const LineObservation& observation, const Pose2& T_local_body);
  std::size_t drop_unseen_landmarks();
  static void extend_prior(LandmarkPrior& prior, const Line2& line, const Point2& start, const Point2& end);

  FixedVector<PoseVertex, kCapacity.poses> poses_;
  FixedVector<Landmark, kCapacity.landmarks> landmarks_;
  FixedVector<LineObservation, kCapacity.observations> observations_;  // in the order of their poses
};

}  // namespace swiftlet

#include "core/frontend/landmark_graph_impl.hpp"

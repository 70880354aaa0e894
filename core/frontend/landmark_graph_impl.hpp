// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

// Definitions of the members of LandmarkGraph; included by landmark_graph.hpp alone.
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "core/frontend/landmark_graph.hpp"
#include "core/geometry/pose_residual.hpp"

namespace swiftlet {

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraph<kCapacity>::add_first_pose(KeyframeId id, const Pose2& T_local_body) {
  SWIFTLET_CHECK(poses_.empty(), "the first pose is added to an empty graph");
  const bool has_room = poses_.try_push_back({id, T_local_body, Pose2(), Eigen::Matrix3d::Zero()});
  SWIFTLET_CHECK(has_room, "a graph has room for a pose");
}

template <LandmarkGraphCapacity kCapacity>
bool LandmarkGraph<kCapacity>::try_add_pose(KeyframeId id, const UncertainMotion& motion) {
  SWIFTLET_CHECK(!poses_.empty(), "motion leads from a pose");
  return poses_.try_push_back({id, poses_.back().T_local_body * motion.T_from_to, motion.T_from_to,
                               residual_information(motion.T_from_to, motion.covariance)});
}

template <LandmarkGraphCapacity kCapacity>
bool LandmarkGraph<kCapacity>::try_add_landmark(LandmarkId id, const LineSegment& segment) {
  if (landmarks_.full() || observations_.full()) return false;
  const Pose2& T_local_body = poses_.back().T_local_body;
  Landmark landmark;
  landmark.id = id;
  const TransformedLine seen = transform_line(T_local_body, segment.line);
  landmark.line_local = seen.line_b;
  landmark.covariance = seen.J_line * segment.covariance * seen.J_line.transpose();
  landmark.start_local = T_local_body * segment.start;
  landmark.end_local = T_local_body * segment.end;
  return landmarks_.try_push_back(landmark) && try_observe(landmarks_.size() - 1, segment);
}

template <LandmarkGraphCapacity kCapacity>
bool LandmarkGraph<kCapacity>::try_observe(std::size_t landmark, const LineSegment& segment) {
  const Eigen::Matrix2d information = segment.covariance.inverse();
  if (!observations_.try_push_back(
          {poses_.size() - 1, landmark, segment.line, information, segment.start, segment.end}))
    return false;
  Landmark& seen = landmarks_[landmark];
  seen.seen_from_local = poses_.back().T_local_body.position();
  seen.last_seen = poses_.back().id;
  ++seen.observation_count;
  return true;
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraph<kCapacity>::add_direction_prior_to_newest(double alpha_local_rad, double information) {
  LandmarkPrior& prior = landmarks_.back().prior;
  prior.mean_local = {landmarks_.back().line_local.rho_m, alpha_local_rad};
  prior.information(1, 1) = information;
}

template <LandmarkGraphCapacity kCapacity>
std::size_t LandmarkGraph<kCapacity>::marginalize_oldest_pose() {
  SWIFTLET_CHECK(poses_.size() > 1, "a pose remains as gauge");
  std::size_t folded = 0;
  while (folded < observations_.size() && observations_[folded].pose == 0)
    fold(observations_[folded++], poses_.front().T_local_body);
  observations_.erase_front(folded);
  for (LineObservation& observation : observations_) --observation.pose;
  poses_.erase_front(1);
  return drop_unseen_landmarks();
}

// The pose is fixed from now on: its measured line, in the local frame, joins the prior by an
// information-weighted mean.
template <LandmarkGraphCapacity kCapacity>
void LandmarkGraph<kCapacity>::fold(const LineObservation& observation, const Pose2& T_local_body) {
  Landmark& landmark = landmarks_[observation.landmark];
  const LineError at_estimate = line_error(observation.line_body, T_local_body, landmark.line_local);
  const Eigen::Matrix2d information =
      at_estimate.J_line.transpose() * observation.information * at_estimate.J_line;
  // Both as corrections of the present estimate, where all is linear.
  const Eigen::Vector2d pull =
      -at_estimate.J_line.transpose() * observation.information * at_estimate.error +
      landmark.prior.information * line_difference(landmark.prior.mean_local, landmark.line_local);
  landmark.prior.information += information;
  const Eigen::Vector2d correction = landmark.prior.information.inverse() * pull;
  landmark.prior.mean_local = {landmark.line_local.rho_m + correction(0),
                               wrap_angle(landmark.line_local.alpha_rad + correction(1))};
  extend_prior(landmark.prior, landmark.line_local, T_local_body * observation.start_body,
               T_local_body * observation.end_body);
  --landmark.observation_count;
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraph<kCapacity>::extend_prior(LandmarkPrior& prior, const Line2& line, const Point2& start,
                                            const Point2& end) {
  double low_m = std::min(line.along_m(start), line.along_m(end));
  double high_m = std::max(line.along_m(start), line.along_m(end));
  if (prior.has_extent) {
    low_m = std::min({low_m, line.along_m(prior.start_local), line.along_m(prior.end_local)});
    high_m = std::max({high_m, line.along_m(prior.start_local), line.along_m(prior.end_local)});
  }
  prior.has_extent = true;
  prior.start_local = line.point_at(low_m);
  prior.end_local = line.point_at(high_m);
}

template <LandmarkGraphCapacity kCapacity>
std::size_t LandmarkGraph<kCapacity>::drop_unseen_landmarks() {
  std::array<std::size_t, kCapacity.landmarks> new_index{};
  std::size_t kept = 0;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    if (landmarks_[i].observation_count == 0) continue;
    new_index[i] = kept;
    if (kept != i) landmarks_[kept] = landmarks_[i];
    ++kept;
  }
  const std::size_t dropped = landmarks_.size() - kept;
  landmarks_.truncate(kept);
  for (LineObservation& observation : observations_) observation.landmark = new_index[observation.landmark];
  return dropped;
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraph<kCapacity>::update_end_points() {
  std::array<double, kCapacity.landmarks> low_m;
  std::array<double, kCapacity.landmarks> high_m;
  const auto include = [&](std::size_t i, const Point2& p) {
    const double t = landmarks_[i].line_local.along_m(p);
    low_m[i] = std::min(low_m[i], t);
    high_m[i] = std::max(high_m[i], t);
  };
  low_m.fill(std::numeric_limits<double>::infinity());
  high_m.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    if (!landmarks_[i].prior.has_extent) continue;
    include(i, landmarks_[i].prior.start_local);
    include(i, landmarks_[i].prior.end_local);
  }
  for (const LineObservation& observation : observations_) {
    const Pose2& T_local_body = poses_[observation.pose].T_local_body;
    include(observation.landmark, T_local_body * observation.start_body);
    include(observation.landmark, T_local_body * observation.end_body);
  }
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    landmarks_[i].start_local = landmarks_[i].line_local.point_at(low_m[i]);
    landmarks_[i].end_local = landmarks_[i].line_local.point_at(high_m[i]);
  }
}

template <LandmarkGraphCapacity kCapacity>
double LandmarkGraph<kCapacity>::chi_square() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < poses_.size(); ++i) {
    const Eigen::Vector3d e =
        pose_residual(poses_[i].T_previous_body, poses_[i - 1].T_local_body, poses_[i].T_local_body).error;
    sum += e.dot(poses_[i].information * e);
  }
  for (const LineObservation& observation : observations_) {
    const Eigen::Vector2d e = line_error(observation.line_body, poses_[observation.pose].T_local_body,
                                         landmarks_[observation.landmark].line_local)
                                  .error;
    sum += e.dot(observation.information * e);
  }
  for (const Landmark& landmark : landmarks_) {
    const Eigen::Vector2d e = line_difference(landmark.prior.mean_local, landmark.line_local);
    sum += e.dot(landmark.prior.information * e);
  }
  return sum;
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraph<kCapacity>::save(Checkpoint& checkpoint) const {
  checkpoint.poses_ = poses_;
  checkpoint.landmarks_ = landmarks_;
  checkpoint.observations_ = observations_.size();
}

template <LandmarkGraphCapacity kCapacity>
void LandmarkGraph<kCapacity>::restore(const Checkpoint& checkpoint) {
  poses_ = checkpoint.poses_;
  landmarks_ = checkpoint.landmarks_;
  observations_.truncate(checkpoint.observations_);
}

}  // namespace swiftlet

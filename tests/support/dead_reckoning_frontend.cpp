// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tests/support/dead_reckoning_frontend.hpp"

#include <Eigen/Core>
#include <cmath>

namespace swiftlet {
namespace {

constexpr double kKeyframeDistanceM = 0.5;
constexpr double kKeyframeTurnRad = radians(30.0);

}  // namespace

FrontendStep DeadReckoningFrontend::process(const RangeSample& sample) {
  FrontendStep step;
  step.sample = sample;
  step.T_local_body = sample.T_odom_body;
  step.T_dead_body = sample.T_odom_body;
  const Pose2 moved = between(T_odom_keyframe_, sample.T_odom_body);
  const bool is_elsewhere = sample.starts_segment || sample.storey != storey_;
  if (!started_ || is_elsewhere || std::hypot(moved.x_m(), moved.y_m()) >= kKeyframeDistanceM ||
      std::abs(moved.yaw_rad()) >= kKeyframeTurnRad) {
    make_keyframe(step);
  }
  step.keyframe = newest_;
  step.T_keyframe_body = between(T_odom_keyframe_, sample.T_odom_body);
  return step;
}

void DeadReckoningFrontend::make_keyframe(FrontendStep& step) {
  const Pose2 moved = between(T_odom_keyframe_, step.sample.T_odom_body);
  const double distance_m = std::hypot(moved.x_m(), moved.y_m());
  const double sigma_m = noise_.floor_m + noise_.per_metre_m * distance_m;
  const double sigma_rad = noise_.floor_rad + noise_.per_metre_rad * distance_m;
  newest_ = started_ ? static_cast<KeyframeId>(index_of(newest_) + 1) : KeyframeId{};
  started_ = true;
  T_odom_keyframe_ = step.sample.T_odom_body;
  storey_ = step.sample.storey;
  if (T_local_keyframe_.full()) T_local_keyframe_.erase(0);
  const bool added = T_local_keyframe_.try_push_back(step.sample.T_odom_body);
  SWIFTLET_CHECK(added, "room was made for one keyframe");
  step.has_keyframe = true;
  step.made.id = newest_;
  step.made.starts_segment = step.sample.starts_segment;
  step.made.odometry_ran_on = step.sample.odometry_ran_on;
  step.made.motion_covariance = {
      .xx = sigma_m * sigma_m, .yy = sigma_m * sigma_m, .yaw_yaw = sigma_rad * sigma_rad};
  step.made.T_local_keyframe = T_local_keyframe_;
}

}  // namespace swiftlet

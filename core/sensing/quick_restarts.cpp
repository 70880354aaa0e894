// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/quick_restarts.hpp"

#include <chrono>
#include <cmath>

namespace swiftlet {
namespace {

/// On the arc of the step.
Pose2 flown_on(const Pose2& step, double steps) {
  const Pose2 chord(0.0, 0.0, 0.5 * (steps - 1.0) * step.yaw_rad());
  const Point2 end = chord * Point2{steps * step.x_m(), steps * step.y_m()};
  return {end.x_m, end.y_m, steps * step.yaw_rad()};
}

}  // namespace

void QuickRestarts::mend(RangeSample& sample) {
  const Pose2 T_reported_body = sample.T_odom_body;
  const bool was_measured = !sample.starts_segment;
  if (last_ && sample.starts_segment && !sample.odometry_ran_on && mended_.size() < kMostRecords) {
    if (is_quick(sample)) {
      const double steps = to_seconds(sample.measured_at - last_->measured_at) / to_seconds(last_->took);
      T_mended_reported_ =
          last_->T_mended_body * flown_on(last_->T_previous_this, steps) * T_reported_body.inverse();
      sample.starts_segment = false;
      ++count_;
      mended_.push_back({sample.stamp, T_mended_reported_});
    } else if (!mended_.empty()) {
      T_mended_reported_ = Pose2();
      mended_.push_back({sample.stamp, T_mended_reported_});
    }
  }
  if (!mended_.empty()) sample.T_odom_body = T_mended_reported_ * T_reported_body;
  Step here{sample.measured_at, sample.stamp, sample.T_odom_body, {}, {}};
  if (last_ && was_measured) {
    here.T_previous_this = between(last_->T_mended_body, sample.T_odom_body);
    here.took = sample.measured_at - last_->measured_at;
  }
  last_ = here;
}

/// Behind a measured step of a vehicle that moved, and not much longer than that: it says nothing of later.
bool QuickRestarts::is_quick(const RangeSample& sample) const {
  const Pose2& step = last_->T_previous_this;
  const double took_s = to_seconds(last_->took);
  const double far_m = std::hypot(step.x_m(), step.y_m());
  const bool moved =
      far_m > kStandsBelowMPerS * took_s || std::abs(step.yaw_rad()) > kStandsBelowRadPerS * took_s;
  const Duration elapsed = sample.measured_at - last_->measured_at;
  return moved && far_m < kTopSpeedMPerS * took_s && elapsed > Duration::zero() &&
         elapsed < kUnwatchedAfter && elapsed <= kMostSteps * last_->took &&
         std::chrono::abs(sample.stamp - last_->stamp) < kUnwatchedAfter;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/quick_restarts.hpp"

#include <chrono>
#include <cmath>

#include "core/sensing/flight_limits.hpp"

namespace swiftlet {

void QuickRestarts::mend(RangeSample& sample) {
  const Pose2 T_reported_body = sample.T_odom_body;
  const bool was_measured = !sample.starts_segment;
  const bool has_restarted = last_ && sample.starts_segment && !sample.odometry_ran_on;
  if (has_restarted && frame_.has_room()) {
    if (is_quick(sample)) {
      frame_.change(sample.stamp, flown_on(sample) * T_reported_body.inverse());
      sample.starts_segment = false;
      ++count_;
    } else if (count_ > 0) {
      frame_.change(sample.stamp, Pose2());
    }
  }
  sample.T_odom_body = frame_.mended(T_reported_body);
  Step here{sample.measured_at, sample.stamp, sample.T_odom_body, {}, {}};
  if (last_ && was_measured) {
    here.T_previous_this = between(last_->T_mended_body, sample.T_odom_body);
    here.took = sample.measured_at - last_->measured_at;
  }
  last_ = here;
}

/// Where the vehicle is then, on the arc of its last step.
Pose2 QuickRestarts::flown_on(const RangeSample& sample) const {
  const Pose2& step = last_->T_previous_this;
  const double steps = to_seconds(sample.measured_at - last_->measured_at) / to_seconds(last_->took);
  const Pose2 turned(0.0, 0.0, 0.5 * (steps - 1.0) * step.yaw_rad());
  return last_->T_mended_body * turned *
         Pose2(steps * step.x_m(), steps * step.y_m(), 0.5 * (steps + 1.0) * step.yaw_rad());
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

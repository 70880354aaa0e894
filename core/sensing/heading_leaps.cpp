// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/heading_leaps.hpp"

#include <cmath>

#include "core/base/time.hpp"
#include "core/geometry/squared.hpp"

namespace swiftlet {

void HeadingLeaps::mend(RangeSample& sample) {
  const Pose2 T_reported_body = sample.T_odom_body;
  if (!last_ || (sample.starts_segment && !sample.odometry_ran_on)) {
    begin_anew(sample);
  } else {
    const Pose2 step = between(last_->T_reported_body, T_reported_body);
    const double turn_rad = turn_of_step(step.yaw_rad(), to_seconds(sample.measured_at - last_->measured_at));
    if (turn_rad != step.yaw_rad()) {
      const Pose2 T_mended_body =
          T_mended_reported_ * last_->T_reported_body * Pose2(step.x_m(), step.y_m(), turn_rad);
      T_mended_reported_ = T_mended_body * T_reported_body.inverse();
      mended_.push_back({sample.stamp, T_mended_reported_});
    }
  }
  last_ = Step{sample.measured_at, T_reported_body};
  if (!mended_.empty()) sample.T_odom_body = T_mended_reported_ * T_reported_body;
}

/// Of the dead reckoning that begins with this sample nothing is known yet.
void HeadingLeaps::begin_anew(const RangeSample& sample) {
  rate_rad_per_s_.reset();
  held_back_rad_ = 0.0;
  steps_held_back_ = 0;
  if (mended_.empty() || !has_room()) return;
  T_mended_reported_ = Pose2();
  mended_.push_back({sample.stamp, T_mended_reported_});
}

/// As it is passed on.
double HeadingLeaps::turn_of_step(double reported_rad, double elapsed_s) {
  if (elapsed_s <= 0.0) return reported_rad;
  const double expected_rad = rate_rad_per_s_.value_or(reported_rad / elapsed_s) * elapsed_s;
  const double limit_rad = kSlackRad + kAccelerationRadPerS2 * squared(elapsed_s) / 2.0;
  const bool is_too_much = std::abs(reported_rad) - std::abs(expected_rad) > limit_rad;
  if (is_too_much && steps_held_back_ < kMostSteps && has_room()) {
    held_back_rad_ += reported_rad - expected_rad;
    ++steps_held_back_;
    return expected_rad;
  }
  if (!is_too_much && steps_held_back_ > 0) ++count_;
  const double flown_after_all_rad = is_too_much ? held_back_rad_ : 0.0;
  held_back_rad_ = 0.0;
  steps_held_back_ = 0;
  rate_rad_per_s_ = reported_rad / elapsed_s;
  return reported_rad + flown_after_all_rad;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/heading_leaps.hpp"

#include <cmath>
#include <utility>

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
          frame_.mended(last_->T_reported_body) * Pose2(step.x_m(), step.y_m(), turn_rad);
      frame_.change(sample.stamp, T_mended_body * T_reported_body.inverse());
    }
  }
  last_ = Step{sample.measured_at, T_reported_body};
  sample.T_odom_body = frame_.mended(T_reported_body);
}

/// Of the dead reckoning that begins with this sample nothing is known yet.
void HeadingLeaps::begin_anew(const RangeSample& sample) {
  rate_rad_per_s_.reset();
  turn_ = {};
  if (!frame_.changes().empty() && frame_.has_room()) frame_.change(sample.stamp, Pose2());
}

/// From one rate to itself.
double HeadingLeaps::most_within_rad(double time_s) const {
  const double a = tuning_.acceleration_rad_per_s2;
  const double b = tuning_.braking_rad_per_s2;
  return tuning_.slack_rad + squared(time_s) / 2.0 * a * b / (a + b);
}

/// As it is passed on.
double HeadingLeaps::turn_of_step(double reported_rad, double elapsed_s) {
  if (elapsed_s <= 0.0) return reported_rad;
  if (!rate_rad_per_s_ || elapsed_s > tuning_.longest_step_s) return end_turn(reported_rad, elapsed_s, false);
  if (turn_.steps == 0) rate_before_rad_per_s_ = *rate_rad_per_s_;
  const double excess_rad = reported_rad - rate_before_rad_per_s_ * elapsed_s;
  const bool as_before = std::abs(excess_rad) <= tuning_.slack_rad;
  if (as_before || turn_.steps == kMostSteps || !frame_.has_room())
    return end_turn(reported_rad, elapsed_s, as_before);
  ++turn_.steps;
  turn_.time_s += elapsed_s;
  turn_.excess_rad += excess_rad;
  const double most_rad = std::abs(*rate_rad_per_s_) * elapsed_s + tuning_.slack_rad +
                          tuning_.acceleration_rad_per_s2 * squared(elapsed_s) / 2.0;
  if (std::abs(reported_rad) > most_rad) {
    turn_.held_back_rad += excess_rad;
    return reported_rad - excess_rad;
  }
  rate_rad_per_s_ = reported_rad / elapsed_s;
  return reported_rad;
}

/// With the step behind it, which is passed on with what is to be made good.
double HeadingLeaps::end_turn(double reported_rad, double elapsed_s, bool as_before) {
  const Turn turn = std::exchange(turn_, {});
  rate_rad_per_s_ = reported_rad / elapsed_s;
  const bool is_leap = as_before && std::abs(turn.excess_rad) > most_within_rad(turn.time_s);
  if (is_leap) ++count_;
  return reported_rad + turn.held_back_rad - (is_leap ? turn.excess_rad : 0.0);
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/sensing/mended_odometry.hpp"
#include "core/sensing/range_sample.hpp"

namespace swiftlet {

struct HeadingLeapTuning {
  double slack_rad = 0.035;  ///< within which two steps turn as fast: stamps that err by 10 ms, at 200 deg/s
  double acceleration_rad_per_s2 = 20.0;  ///< no step of 12 real flights begins a turn with more than 16
  double braking_rad_per_s2 = 40.0;       ///< ... and none ends one with more than 38
  double longest_step_s = 0.3;  ///< beyond it a vehicle can turn by 34 degrees and stop: nothing is told
};

/// Takes turns that a flying vehicle does not make out of its dead reckoning: over one step, or over two, its
/// heading goes elsewhere, and then it turns as fast as before. Such a turn is an error of the estimate where
/// a vehicle could not have begun and ended it within that time, T: the most is T² / 2 a b / (a + b), of
/// acceleration a and braking b. (Interpolation between readings spreads a leap of the estimate over two
/// steps.) A step that begins to turn faster than a vehicle can is held back at once, others are passed on
/// until the next steps have shown what they were; then what is too little or too much is made good.
///
/// A vehicle that is twisted within two samples, by a blow, and turns on as before, is taken for a leap.
/// @note Allocates in the constructor only. One thread at a time.
class HeadingLeaps {
 public:
  explicit HeadingLeaps(const HeadingLeapTuning& tuning = {}) : tuning_(tuning) {}

  /// Makes the dead reckoning of the next sample one without those turns.
  void mend(RangeSample& sample);
  /// How many were taken out.
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const std::vector<MendedOdometry>& mended() const { return frame_.changes(); }

 private:
  struct Step {
    DeviceTime measured_at{};
    Pose2 T_reported_body;
  };
  /// Steps that turn otherwise than the one before them.
  struct Turn {
    int steps = 0;
    double time_s = 0.0;
    double excess_rad = 0.0;  // beyond the rate before
    double held_back_rad = 0.0;
  };

  static constexpr int kMostSteps = 2;

  [[nodiscard]] double most_within_rad(double time_s) const;
  double turn_of_step(double reported_rad, double elapsed_s);
  double end_turn(double reported_rad, double elapsed_s, bool as_before);
  void begin_anew(const RangeSample& sample);

  HeadingLeapTuning tuning_;
  std::optional<Step> last_;
  std::optional<double> rate_rad_per_s_;  // of the last step that was not held back, as reported
  double rate_before_rad_per_s_ = 0.0;    // of the last step before turn_
  Turn turn_;
  std::size_t count_ = 0;
  MendedFrame frame_;
};

}  // namespace swiftlet

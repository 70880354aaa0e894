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

/// Takes turns that no vehicle can fly out of a flying vehicle's dead reckoning: its heading is elsewhere
/// from one sample to the next, or over two, and then it turns as fast as before. Such a turn is an error of
/// the estimate, and the vehicle is taken to have turned on at the rate it had. A turn that goes on for
/// longer is flown: what was held back of it is given with its third sample.
///
/// A turn is too much for one step of time t if it exceeds what the rate before makes expected by more than
/// slack + acceleration t² / 2. On 12 flights of real Crazyflies, at 10 Hz, none exceeds it by more than 2.9
/// degrees in flight and 4.7 at a take-off (16 rad/s²); two rotors at full thrust and two at none give
/// 60 rad/s² (0.15 N, torque over thrust 6 mm, 2.9e-5 kg m²). Braking may be harder, and is no leap. So steps
/// of a third of a second and more show nothing; wheels, whose stamps come in bunches, are left out.
/// @note Allocates in the constructor only. One thread at a time.
class HeadingLeaps {
 public:
  HeadingLeaps() { mended_.reserve(kMostRecords + 1); }

  /// Makes the dead reckoning of the next sample one without those turns.
  void mend(RangeSample& sample);
  /// How many were taken out.
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const std::vector<MendedOdometry>& mended() const { return mended_; }

 private:
  struct Step {
    DeviceTime measured_at{};
    Pose2 T_reported_body;
  };

  static constexpr double kSlackRad = 0.035;             // stamps: 10 ms at 200 degrees a second
  static constexpr double kAccelerationRadPerS2 = 20.0;  // above
  static constexpr int kMostSteps = 2;  // interpolation between readings spreads a leap over two samples
  static constexpr std::size_t kMostRecords = 300;  // an estimate with a hundred leaps is passed on as it is

  [[nodiscard]] bool has_room() const { return mended_.size() < kMostRecords; }
  double turn_of_step(double reported_rad, double elapsed_s);
  void begin_anew(const RangeSample& sample);

  std::optional<Step> last_;
  std::optional<double> rate_rad_per_s_;  // as reported, before what is held back
  double held_back_rad_ = 0.0;
  int steps_held_back_ = 0;
  Pose2 T_mended_reported_;
  std::size_t count_ = 0;
  std::vector<MendedOdometry> mended_;
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/mended_odometry.hpp"
#include "core/sensing/range_sample.hpp"

namespace swiftlet {

/// Joins dead reckoning that restarts in flight, within kUnwatchedAfter by the clocks of vehicle and host
/// (the firmware resets an estimate that has run away): the vehicle flew on as in the step before, and no
/// segment begins. Nothing is joined where that step was as slow as noise, since the vehicle may have stood
/// and been carried, faster than it flies, or much shorter than the restart.
/// @note Allocates in the constructor only. One thread at a time.
class QuickRestarts {
 public:
  /// Makes the dead reckoning of the next sample one that runs on.
  void mend(RangeSample& sample);
  /// How many were joined.
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const std::vector<MendedOdometry>& mended() const { return frame_.changes(); }

 private:
  struct Step {
    DeviceTime measured_at{};
    HostTime stamp{};
    Pose2 T_mended_body;
    Pose2 T_previous_this;  // if it was measured
    Duration took{};        // likewise
  };

  static constexpr int kMostSteps = 3;  // of the one before: two packets may be lost
  // A vehicle on the floor whose odometry is not frozen drifts by less. Assumed, not measured.
  static constexpr double kStandsBelowMPerS = 0.1;
  static constexpr double kStandsBelowRadPerS = 0.1;

  [[nodiscard]] bool is_quick(const RangeSample& sample) const;
  [[nodiscard]] Pose2 flown_on(const RangeSample& sample) const;

  std::optional<Step> last_;
  std::size_t count_ = 0;
  MendedFrame frame_;
};

}  // namespace swiftlet

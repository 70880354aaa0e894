// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/mended_odometry.hpp"
#include "core/sensing/range_sample.hpp"

namespace swiftlet {

/// A vehicle that flies is unwatched after so long without dead reckoning. In less it cannot get far, and
/// none can boot.
inline constexpr Duration kUnwatchedAfter = std::chrono::seconds(1);

/// No vehicle flies faster: its estimate does.
inline constexpr double kTopSpeedMPerS = 5.0;

/// Joins dead reckoning that restarts in flight, within kUnwatchedAfter by the clocks of vehicle and host
/// (the firmware resets an estimate that has run away): the vehicle flew on as in the step before, and no
/// segment begins. Nothing is joined where that step was as slow as noise, since the vehicle may have stood
/// and been carried, faster than it flies, or much shorter than the restart.
/// @note Allocates in the constructor only. One thread at a time.
class QuickRestarts {
 public:
  QuickRestarts() { mended_.reserve(kMostRecords); }

  /// Makes the dead reckoning of the next sample one that runs on.
  void mend(RangeSample& sample);
  /// How many were joined.
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const std::vector<MendedOdometry>& mended() const { return mended_; }

 private:
  struct Step {
    DeviceTime measured_at{};
    HostTime stamp{};
    Pose2 T_mended_body;
    Pose2 T_previous_this;  // as far as it was measured
    Duration took{};
  };

  static constexpr std::size_t kMostRecords = 300;  // beyond it restarts are passed on as they are
  static constexpr int kMostSteps = 3;              // between two samples: two packets may be lost
  static constexpr double kStandsBelowMPerS = 0.1;  // a vehicle on the floor whose estimate is not frozen
  static constexpr double kStandsBelowRadPerS = 0.1;

  [[nodiscard]] bool is_quick(const RangeSample& sample) const;

  std::optional<Step> last_;
  Pose2 T_mended_reported_;
  std::size_t count_ = 0;
  std::vector<MendedOdometry> mended_;
};

}  // namespace swiftlet

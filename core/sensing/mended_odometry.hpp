// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Dead reckoning that is not passed on as it was reported, of samples stamped `since` and later, up to the
/// next record.
struct MendedOdometry {
  HostTime since{};
  Pose2 T_mended_reported;  ///< frame odom as passed on, and as reported
  bool reversed = false;    ///< the step to the first of them was taken the other way round (LostSign)
};

/// The frame that mended dead reckoning is passed on in. Changes kMostChanges times: dead reckoning that errs
/// on and on is passed on as it is then.
/// @note Allocates in the constructor only. One thread at a time.
class MendedFrame {
 public:
  static constexpr std::size_t kMostChanges = 300;

  MendedFrame() { changes_.reserve(kMostChanges + 1); }

  /// Whether another change may begin.
  [[nodiscard]] bool has_room() const { return changes_.size() < kMostChanges; }
  /// From the sample of this stamp on. Precondition: has_room(), or the first since.
  void change(HostTime since, const Pose2& T_mended_reported) {
    changes_.push_back({since, T_mended_reported});
  }
  [[nodiscard]] Pose2 mended(const Pose2& T_reported) const {
    return changes_.empty() ? T_reported : changes_.back().T_mended_reported * T_reported;
  }
  [[nodiscard]] const std::vector<MendedOdometry>& changes() const { return changes_; }

 private:
  std::vector<MendedOdometry> changes_;
};

/// The reverse: the pose as the odometry reported it. `mended` in order of time; empty where nothing was.
[[nodiscard]] Pose2 as_reported(std::span<const MendedOdometry> mended, HostTime stamp,
                                const Pose2& T_mended);

/// Of what was mended twice. Both in order of time, as is the result. Allocates.
[[nodiscard]] std::vector<MendedOdometry> mended_in_turn(std::span<const MendedOdometry> first,
                                                         std::span<const MendedOdometry> then);

}  // namespace swiftlet

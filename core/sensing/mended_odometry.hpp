// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

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

/// The reverse: the pose as the odometry reported it. `mended` in order of time; empty where nothing was.
[[nodiscard]] Pose2 as_reported(std::span<const MendedOdometry> mended, HostTime stamp,
                                const Pose2& T_mended);

/// Of what was mended twice. Both in order of time, as is the result. Allocates.
[[nodiscard]] std::vector<MendedOdometry> mended_in_turn(std::span<const MendedOdometry> first,
                                                         std::span<const MendedOdometry> then);

}  // namespace swiftlet

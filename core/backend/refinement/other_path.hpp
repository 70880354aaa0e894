// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// The final path of the same run, mapped with another noise of the heading of dead reckoning.
struct OtherPath {
  double yaw_noise_factor = 1.0;
  std::vector<Pose2> T_map_body;  ///< one per scan
};

/// Maps the run again. May read the store of its scans.
using MapAgain = std::function<std::vector<OtherPath>()>;

}  // namespace swiftlet

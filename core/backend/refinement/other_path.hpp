// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/backend/refinement/map_source.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// The final path of the same run, mapped otherwise.
struct OtherPath {
  MapSource source = MapSource::kOtherYawNoise;
  double yaw_noise_factor = 1.0;
  std::vector<Pose2> T_map_body;  ///< one per scan
};

/// Maps the run again. `step_scale`: how many times as long as reported the step to each scan is, one path
/// being asked for; empty: with other noises, and backwards. May read the store of its scans.
using MapAgain = std::function<std::vector<OtherPath>(std::span<const double> step_scale)>;

}  // namespace swiftlet

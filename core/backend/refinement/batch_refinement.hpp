// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <span>
#include <vector>

#include "core/backend/config/backend_config.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/store/scan_store.hpp"
#include "core/base/result.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

struct RefinementReport {
  int iterations = 0;
  double held_out_before_m =
      0.0;  ///< robust mean distance of held-out returns from the walls of other traversals
  double held_out_after_m = 0.0;
  bool accepted = false;  ///< false: it would have explained the held-out returns worse; poses untouched
};

/// Joint refinement of every scan's pose: returns are pulled along the normal of the wall that the other
/// traversals draw around them, with dead reckoning between neighbouring scans and the believed loop
/// closures, all in one sparse Gauss-Newton problem, walls and poses in turn until nothing moves. A tenth of
/// the returns is held back: the result is taken only if it explains those at least as well as the start did.
/// Needs a start with walls within about half a metre of each other: it polishes, it does not close loops.
/// `T_map_body`: one pose per scan, in and out, the first one is held. `closures` join scans (information
/// scaled by DCS already); `headings` likewise. Errors: kSolver.
/// Allocates. Repeatable.
Result<RefinementReport> refine_scan_poses(const ScanStore& scans, const SensorModel& sensor,
                                           std::span<const RelativePoseFactor<ScanId>> closures,
                                           std::span<const HeadingFactor<ScanId>> headings,
                                           const BackendConfig& config, std::vector<Pose2>& T_map_body);

}  // namespace swiftlet

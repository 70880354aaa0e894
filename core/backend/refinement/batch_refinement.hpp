// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/backend/config/backend_config.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/refinement/refinement_problem.hpp"
#include "core/backend/store/scan_store.hpp"
#include "core/base/result.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

struct RefinementReport : HeldOutVerdict {
  int iterations = 0;
  bool moved_walls = false;     ///< false: refine_jointly() had no solution; the poses are those before it
  double share_on_walls = 0.0;  ///< of the held-out returns: that lie on walls of other traversals
  /// By traversal, in order: minus the log likelihood of the poses returned, but for a constant. Of the
  /// held-out returns (distance over wall sigma) and of the dead reckoning (half chi-square). Comparable
  /// between starts of one run.
  std::vector<double> misfit;
  std::vector<double> misfit_at_start;
};

/// The dead reckoning that joins neighbouring scans.
enum class DeadReckoning : std::uint8_t {
  kLessDrift,   ///< StoredScan::T_dead_body
  kAsReported,  ///< StoredScan::T_odom_body, calibrated
};

/// Joint refinement of every scan's pose: one sparse Gauss-Newton problem of point-to-line factors to the
/// walls of other traversals, dead reckoning between neighbouring scans, and accepted loop closures. Walls
/// and poses are computed in turn until no pose moves, then together (refine_jointly()). A tenth of the
/// returns is held out: the result is accepted only if they lie as close to their walls as at the start. The
/// start must have its walls within about half a metre of each other: refinement closes no loops.
/// `T_map_body`: one pose per scan, in and out, the first one is held. `closures` join scans (information
/// scaled by DCS already); `headings` likewise. Errors: kSolver. Allocates. Repeatable.
Result<RefinementReport> refine_scan_poses(const ScanStore& scans, const SensorModel& sensor,
                                           std::span<const RelativePoseFactor<ScanId>> closures,
                                           std::span<const HeadingFactor<ScanId>> headings,
                                           const BackendConfig& config, std::vector<Pose2>& T_map_body,
                                           const RefinementTuning& tuning = {},
                                           DeadReckoning dead_reckoning = DeadReckoning::kLessDrift);

}  // namespace swiftlet

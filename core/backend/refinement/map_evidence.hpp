// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <span>

#include "core/backend/store/scan_store.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Log probability of what the beams of all scans have met, seen from `T_map_body`, one pose per scan, given
/// that the ground does not change: higher where visits agree on it, and where a place that was visited twice
/// is drawn once. Each traversal votes once on each square cell of `cell_m`: a wall where a beam ends, free
/// where beams only pass. Cells are independent, and how often one is met as a wall is unknown beforehand:
/// the estimator of Krichevsky and Trofimov, "The performance of universal encoding", IEEE Transactions on
/// Information Theory 27 (2), 1981, which has no parameter. Beams without return add nothing. `T_grid_map`:
/// where the grid lies. Comparable between paths of one run. Allocates. Repeatable.
[[nodiscard]] double log_evidence_in_grid(const ScanStore& scans, std::span<const Pose2> T_map_body,
                                          double cell_m, const Pose2& T_grid_map);

/// The mean over grids that lie and are turned otherwise: a wall beside a line of the grid falls into one row
/// of cells, on it into two. Likewise.
[[nodiscard]] double map_log_evidence(const ScanStore& scans, std::span<const Pose2> T_map_body,
                                      double cell_m);

}  // namespace swiftlet

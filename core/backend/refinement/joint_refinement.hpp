// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/backend/config/backend_tuning.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/refinement/floor_field.hpp"
#include "core/backend/refinement/poses_and_walls.hpp"
#include "core/backend/refinement/refinement_problem.hpp"
#include "core/backend/refinement/rigid_nodes.hpp"
#include "core/backend/store/scan_store.hpp"
#include "core/base/result.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

/// One least-squares problem over the poses of all scans and the walls that they see. Batch refinement holds
/// the walls of one round while the poses move: what only a whole stretch of walls and poses could do
/// together, as a corridor that is bent or too long, it approaches over hundreds of rounds. Here a wall is a
/// patch, half a metre of one face, whose place and direction are unknowns like the poses. Patches are found
/// again as the poses converge. Held-out returns take no part.
///
/// The age of the ranges and the scales of the odometry are unknowns, too, near those assumed: whole walls
/// show them best.
///
/// `factors`: dead reckoning from each scan to the next, then closures; in and out, the dead reckoning less
/// what was found of age and scales. `headings`: of scans. `T_map_body`: one pose per scan, in and out, the
/// first one is held; traversals over one wall must lie within a decimetre. Errors: kSolver; all is then as
/// it was. Allocates. Repeatable. Precondition: two scans.
[[nodiscard]] Status refine_jointly(std::span<const StoredScan> scans, const SensorModel& sensor,
                                    std::span<const PlacedReturn> returns,
                                    std::span<const HeadingFactor<PoseIndex>> headings,
                                    const BackendTuning& tuning,
                                    std::vector<RelativePoseFactor<PoseIndex>>& factors,
                                    std::vector<Pose2>& T_map_body);
/// The same with what the floors do to a flow sensor as further unknowns (FloorField). The dead reckoning in
/// `factors` is as reported, out less what was found of floors, too.
[[nodiscard]] Result<FloorFindings> refine_jointly_with_floor(
    std::span<const StoredScan> scans, const SensorModel& sensor, std::span<const PlacedReturn> returns,
    std::span<const HeadingFactor<PoseIndex>> headings, const BackendTuning& tuning,
    std::vector<RelativePoseFactor<PoseIndex>>& factors, std::vector<Pose2>& T_map_body);

/// The scans as nodes, by dead reckoning from each scan to the next.
[[nodiscard]] RigidNodes nodes_of(std::span<const StoredScan> scans,
                                  std::span<const RelativePoseFactor<PoseIndex>> motions,
                                  const RigidNodesTuning& tuning);

/// The problem alone, for a caller that solves it step by step. Views nothing of its arguments.
[[nodiscard]] std::unique_ptr<PosesAndWalls> joint_problem(
    std::span<const StoredScan> scans, const SensorModel& sensor, std::span<const PlacedReturn> returns,
    std::span<const HeadingFactor<PoseIndex>> headings, const BackendTuning& tuning,
    std::span<const RelativePoseFactor<PoseIndex>> factors, std::span<const Pose2> T_map_body);
/// Its solution so far, one pose per scan, from where the first is held.
[[nodiscard]] std::vector<Pose2> path_of(const PosesAndWalls& problem, const Pose2& T_map_first);

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "core/backend/refinement/wall_map.hpp"
#include "core/backend/store/scan_store.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

// What the refinement of a whole run and that of a window share: returns that pull at poses along the normal
// of walls, and dead reckoning that holds neighbouring scans together. Nothing here allocates.

inline constexpr std::uint32_t kHoldOutEvery = 10;

/// Signed, along the wall's normal.
[[nodiscard]] double distance_m(const LocalWall& wall, const Point2& p_map);

/// How far a return lies from its wall as a judge of poses sees it: capped, and no wall counts full.
[[nodiscard]] double judged_distance_m(const std::optional<LocalWall>& wall, const Point2& p_map);

/// The normal equations of one return on the pose of its scan.
struct PointToLineFactor {
  Eigen::Matrix3d H;
  Eigen::Vector3d rhs;
};
/// Robust (Geman-McClure): what lies far off its wall loses its say.
[[nodiscard]] PointToLineFactor point_to_line_factor(const LocalWall& wall, const Pose2& T_map_body,
                                                     const Point2& p_body);

/// Information of the dead reckoning from `from` to the next scan `to`; next to nothing where it began anew.
[[nodiscard]] Eigen::Matrix3d motion_information(const StoredScan& from, const StoredScan& to,
                                                 const OdometryNoise& noise);

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/backend/config/backend_tuning.hpp"
#include "core/backend/refinement/wall_map.hpp"
#include "core/backend/store/scan_store.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/sensor_model.hpp"

namespace swiftlet {

// Factors of joint refinement: from a return to the line of its wall, and by dead reckoning from a scan to
// the next. Nothing here allocates.

/// Signed, along the wall's normal.
[[nodiscard]] double distance_m(const LocalWall& wall, const Point2& p_map);

/// Distance of a held-out return from its wall, capped; the cap without a wall.
[[nodiscard]] double judged_distance_m(const std::optional<LocalWall>& wall, const Point2& p_map,
                                       const RefinementTuning& tuning);

/// The normal equations of one return on the pose of its scan.
struct PointToLineFactor {
  Eigen::Matrix3d H;
  Eigen::Vector3d rhs;
};
/// Robust (Geman-McClure): the weight falls with the distance from the wall.
[[nodiscard]] PointToLineFactor point_to_line_factor(const LocalWall& wall, const Pose2& T_map_body,
                                                     const Point2& p_body, const RefinementTuning& tuning);

/// The odometry's motion from `from` to the next scan `to`, as reported but for the sensor's calibration;
/// none where it restarted.
[[nodiscard]] Pose2 reported_motion(const StoredScan& from, const StoredScan& to,
                                    const OdometryCalibration& calibration);

/// Information of the dead reckoning from `from` to the next scan `to`; almost none where it was restarted.
[[nodiscard]] Eigen::Matrix3d motion_information(const StoredScan& from, const StoredScan& to,
                                                 const OdometryNoise& noise);

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/base/ids.hpp"
#include "core/frontend/frontend_config.hpp"
#include "core/frontend/landmark_graph.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// Where a segment was just seen from.
struct Viewpoint {
  Pose2 T_local_body;
  Eigen::Matrix3d covariance;  ///< of T_local_body relative to the walls, as (x, y, yaw)
};

/// Which wall the segment belongs to: eqs. (5)-(8) of "Efficient 2D Graph SLAM for Sparse Sensing" (Zhou, Hu,
/// Liu, Khan; IROS 2022): the nearest by projection error among those that overlap; none when all are too
/// far. Beyond the paper, the two lines must agree within their covariances (short segments lie near a wall
/// at any angle), and a wall has two faces: seen from the other side it is another wall. Walls last seen
/// before `oldest` do not count. Returns an index into `landmarks`. Allocates nothing.
[[nodiscard]] std::optional<std::size_t> associate(std::span<const Landmark> landmarks,
                                                   const LineSegment& segment, const Viewpoint& viewpoint,
                                                   KeyframeId oldest, const FrontendConfig& config);

}  // namespace swiftlet

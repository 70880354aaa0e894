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

/// The pose that observes a line.
struct Viewpoint {
  Pose2 T_local_body;
  Eigen::Matrix3d covariance;  ///< of T_local_body relative to the landmarks, as (x, y, yaw)
};

/// The landmark that a line belongs to: eqs. (5)-(8) of "Efficient 2D Graph SLAM for Sparse Sensing" (Zhou,
/// Hu, Liu, Khan; IROS 2022): the nearest by projection error among those that overlap; none when all are too
/// far. Beyond the paper, the two lines must agree within their covariances (short lines lie near a landmark
/// at any angle), and a wall has two faces: observed from the other side it is another landmark. Landmarks
/// last observed before `oldest` are not considered. Returns an index into `landmarks`. Allocates nothing.
[[nodiscard]] std::optional<std::size_t> associate(std::span<const Landmark> landmarks,
                                                   const LineSegment& segment, const Viewpoint& viewpoint,
                                                   KeyframeId oldest, const FrontendConfig& config);

}  // namespace swiftlet

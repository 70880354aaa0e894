// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>

#include "core/backend/config/backend_tuning.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/pose_graph/slip_noise.hpp"

namespace swiftlet {

/// Covariance of T_from_k for every keyframe k, propagated along the path of least uncertainty (Dijkstra
/// projection: Olson 2008, "Robust and efficient robotic mapping", section 3.4). Closures and headings that
/// DCS scales down too far do not count; a keyframe with a heading gets a Kalman update of its yaw on the
/// way. An upper bound where no heading counts: other paths only add information. What is known of the
/// heading of `from` (by its own, or by the first on the way) counts at each keyframe as if independent:
/// behind many headings the yaw comes out too sure. Allocates; O(m log n).
IdMap<KeyframeId, Eigen::Matrix3d> relative_covariances(const PoseGraph& graph, KeyframeId from,
                                                        const RelativeCovarianceTuning& tuning = {});

/// The same for whoever must not be surprised: each motion has its slip on top, and headings by the axis of
/// the building, which are wrong all together where they are, do not count.
IdMap<KeyframeId, Eigen::Matrix3d> cautious_relative_covariances(const PoseGraph& graph, KeyframeId from,
                                                                 const RelativeCovarianceTuning& tuning,
                                                                 const SlipNoise& slip);

}  // namespace swiftlet

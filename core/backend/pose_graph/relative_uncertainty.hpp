// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>

#include "core/backend/config/backend_tuning.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"

namespace swiftlet {

/// How well each keyframe is known as seen from `from`: covariance of T_from_k for every k, found by carrying
/// the factors' covariances along the path of least uncertainty (Dijkstra projection: Olson 2008, "Robust
/// and efficient robotic mapping", section 3.4). On the safe side: other paths only tell more. Closures count
/// as far as DCS believes them (at least half), and so do headings: a keyframe that has one gets a Kalman
/// update of its yaw on the way. Allocates; O(m log n).
IdMap<KeyframeId, Eigen::Matrix3d> relative_covariances(const PoseGraph& graph, KeyframeId from,
                                                        const RelativeCovarianceTuning& tuning = {});

}  // namespace swiftlet

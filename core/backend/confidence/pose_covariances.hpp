// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/backend/config/backend_tuning.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/store/keyframe_chain.hpp"
#include "core/geometry/covariance3.hpp"

namespace swiftlet {

/// Of the newest keyframe's pose as (x, y, yaw) along the axes of frame map.
struct PoseCovariances {
  Covariance3 from_start;         ///< relative to the first keyframe that is left
  Covariance3 from_surroundings;  ///< relative to the keyframe near by that is best known from here, among
                                  ///< those flown long ago; where there is none, to the oldest near by
};

/// By cautious_relative_covariances(), and never better than a match. Allocates; O(m log n).
[[nodiscard]] PoseCovariances newest_pose_covariances(const PoseGraph& graph, const KeyframeChain& chain,
                                                      const BackendTuning& tuning);

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "core/base/ids.hpp"
#include "core/geometry/covariance3.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// A place that was recognised: one keyframe's scans matched against an earlier submap.
struct LoopClosure {
  ClosureId id{};     ///< given when it is accepted
  FactorId factor{};  ///< what it adds to the pose graph
  KeyframeId from{};  ///< the submap's reference keyframe
  KeyframeId to{};    ///< the keyframe that was matched
  Pose2 T_from_to;
  Covariance3 covariance;  ///< of T_from_to, in the frame of `from`
  double score = 0.0;      ///< mean probability under the matched points
  double dcs_scale = 1.0;  ///< its present scale under DCS, 1 = full weight
  bool dropped = false;    ///< contradicted by what was seen next, or refused in the final pass
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/base/fixed_vector.hpp"
#include "core/base/ids.hpp"
#include "core/geometry/covariance3.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensing/range_sample.hpp"

namespace swiftlet {

/// The most keyframes the frontend keeps optimising at once (its fixed lag).
inline constexpr std::size_t kMaxKeyframeWindow = 64;
/// The most landmarks one keyframe can report.
inline constexpr std::size_t kMaxLandmarksPerKeyframe = 32;

/// The present estimate of a landmark, anchored to the keyframe that observed it last: later corrections of
/// that keyframe move it along. A later update of the same id replaces it.
struct LandmarkUpdate {
  LandmarkId id{};
  Point2 start_keyframe;  ///< end points in the frame of the reporting keyframe
  Point2 end_keyframe;
};

/// A vertex of the graph: every 0.5 m or 30 degrees, and where a segment or storey begins.
struct Keyframe {
  KeyframeId id{};
  Covariance3 motion_covariance;  ///< of T_previous_this, in the frame of the previous keyframe
  bool starts_segment = false;    ///< the motion from the previous keyframe was not measured
  bool odometry_ran_on = false;   ///< with starts_segment: dead reckoning guesses it; else it is unknown
  double innovation = 0.0;  ///< by which the lines seen here, of known walls, raised the graph's chi-square
  std::uint32_t innovation_dof = 0;  ///< degrees of freedom of that; 0: no known wall was seen
  /// The present estimates of the last keyframes, oldest first, this one last (eq. 20 uses the motions
  /// between consecutive ones). Ids are consecutive.
  FixedVector<Pose2, kMaxKeyframeWindow> T_local_keyframe;
  FixedVector<LandmarkUpdate, kMaxLandmarksPerKeyframe> landmarks;
};

/// The frontend's result for one sample: element of the queue from frontend to backend.
struct FrontendStep {
  RangeSample sample;
  Pose2 T_local_body;  ///< online estimate, in the frontend's continuous frame
  Pose2 T_map_body;    ///< the same in the map, with the correction of that time
  Pose2 T_dead_body;  ///< dead reckoning less its estimated drift: continues through keyframes, does not move
                      ///< where a segment starts without it
  KeyframeId keyframe{};      ///< the newest keyframe, this sample's own if it is one
  Pose2 T_keyframe_body;      ///< by dead reckoning from that keyframe
  bool has_keyframe = false;  ///< `made` below is filled: this sample is a keyframe
  Keyframe made;
};
static_assert(std::is_trivially_copyable_v<FrontendStep>);

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

#include "core/backend/pose_graph/slip_noise.hpp"
#include "core/base/ids.hpp"
#include "core/geometry/covariance3.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// What a consumer may rely on.
enum class Tracking : std::uint8_t {
  kTracking,      ///< what is seen agrees with the older map, or is new ground
  kUncertain,     ///< what is seen contradicts the older map: the pose may be off by more than half a metre
  kLost,          ///< motion was not watched, and nothing that was seen since shows where the vehicle is
  kRelocalizing,  ///< likewise, and places in the older map are weighed until one is beyond doubt
};
[[nodiscard]] std::string_view name_of(Tracking tracking);

/// What the state is made of.
struct TrackingFigures {
  Tracking tracking = Tracking::kTracking;
  double contradiction = 0.0;          ///< evidence against the pose: 0 none, 1 what makes it uncertain
  double contradicting_share = 0.0;    ///< of about the last fifty returns on older ground
  std::uint64_t returns_compared = 0;  ///< with older ground, since the start
  std::uint64_t times_uncertain = 0;   ///< since the start
  std::uint32_t places_weighed = 0;    ///< until the place is beyond doubt
  double place_lead = 0.0;  ///< likewise: log-odds of the likeliest place over the next, or over new ground
  double innovation = 0.0;  ///< RecentInnovation
  double way_since_agreement_m = 0.0;  ///< travelled since a return lay on a wall of the older map, or since
                                       ///< the start
  double way_since_closure_m = 0.0;    ///< travelled since the newest closure that holds, or since the start
  double way_unplaced_m = 0.0;         ///< travelled since motion was not watched, until placed
};

/// How well the pose of the newest keyframe is known, and what that is made of. Covariances are of (x, y,
/// yaw) along the axes of frame map, m and rad. Plain struct: crosses threads through a LatestValue.
struct PoseConfidence {
  KeyframeId keyframe{};
  Pose2 T_local_keyframe;
  double yaw_map_local_rad = 0.0;  ///< of the correction it was computed with
  Covariance3 from_start;          ///< relative to the start of the run
  Covariance3 from_surroundings;   ///< relative to the part of the map around the vehicle
  SlipNoise slip;                  ///< by which both grow on the way from the keyframe
  bool has_older_map = false;      ///< a vehicle whose estimate restarts would be kLost in it
  TrackingFigures figures;
};
static_assert(std::is_trivially_copyable_v<PoseConfidence>);

/// Either covariance of a confidence, carried on to the body's present pose in frame local. Allocates
/// nothing.
[[nodiscard]] Covariance3 carried_on(const Covariance3& of_keyframe, const PoseConfidence& confidence,
                                     const Pose2& T_local_body);

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/ids.hpp"
#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "core/geometry/stamped_pose.hpp"

namespace swiftlet {

/// A pose as it was published, the odometry at that moment, and the truth.
struct LiveMoment {
  HostTime stamp{};
  double path_m = 0.0;                        ///< travelled since the start of the run
  Pose2 T_map_body;                           ///< as published
  Pose2 T_local_body;                         ///< in a continuous frame, in which nothing is corrected
  Pose2 T_world_body;                         ///< the truth
  std::optional<Point2> wall_normal_world{};  ///< of the nearest wall, where there is one
  StoreyId storey{};
};

/// A keyframe's pose as it was published over time, and the truth.
struct PublishedKeyframe {
  double path_m = 0.0;                    ///< travelled since the start of the run
  std::vector<StampedPose> T_map_body{};  ///< each from its stamp on, in order
  std::optional<HostTime> erased{};       ///< from then on the map is without it
  Pose2 T_world_body;                     ///< the truth
  StoreyId storey{};
};

struct KnownPlaceTuning {
  double old_after_m = 20.0;  ///< ground flown this much travel ago is old
  double near_m = 3.0;        ///< old ground this close, on one storey, is a known place
  double off_m = 0.3;         ///< a greater error, or a greater jump, counts as one
  double settled_m = 0.2;     ///< a smaller error ends the way back to old ground
  std::array<double, 3> distances_m{2.0, 5.0, 10.0};  ///< at which the map is judged ...
  double ring_m = 0.5;                                ///< ... give or take this
  double contact_gap_m = 5.0;  ///< old ground that is met after this much travel without any is a new contact
};

struct StampedError {
  HostTime stamp{};
  double error_m = 0.0;
};

/// The live pose against the map that it flies in. Without a known place all is 0.
struct KnownPlaceError {
  std::size_t moments = 0;  ///< at known places
  double rms_m = 0.0;
  double p95_m = 0.0;
  double max_m = 0.0;
  double share_off = 0.0;                ///< of the moments: beyond KnownPlaceTuning::off_m
  std::optional<double> across_p95_m{};  ///< across the nearest wall; nothing where no wall was near
  std::optional<double> along_p95_m{};   ///< along it
  std::size_t contacts = 0;              ///< with old ground
  std::size_t contacts_off = 0;          ///< of those, begun with more than settled_m
  double settled_p50_s = 0.0;  ///< of those, until below settled_m, or to the end of the run; 0 without any
  std::size_t jumps = 0;       ///< of the published pose by more than off_m
  double greatest_jump_m = 0.0;
  std::array<std::optional<double>, 3> map_rms_m{};  ///< of old ground at distances_m as seen from the pose
  std::vector<StampedError> errors{};                ///< of each moment
  std::vector<double> across_m{};                    ///< of each with a wall near
  std::vector<double> along_m{};                     ///< likewise
  std::vector<double> settled_s{};                   ///< of each contact that began off
};

/// The published pose at each moment against older keyframes nearby as they were published then, which are
/// aligned to the truth by their mean pose. Moments and keyframes in order of time; allocates.
[[nodiscard]] KnownPlaceError known_place_error(std::span<const LiveMoment> moments,
                                                std::span<const PublishedKeyframe> keyframes,
                                                const KnownPlaceTuning& tuning = {});

}  // namespace swiftlet

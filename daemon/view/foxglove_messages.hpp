// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "daemon/view/run_history.hpp"

namespace swiftlet {

// The messages of foxglove_channels.hpp as JSON. Times are utime of docs/lcm.md, lengths metres, angles
// radians; frames are those of docs/frames_and_units.md.

[[nodiscard]] std::string pose_in_frame_json(std::int64_t utime_us, std::string_view frame,
                                             const Pose2& pose);

/// frame map to local and to odom, local to body.
struct FoxgloveTransforms {
  Pose2 T_map_local;
  Pose2 T_local_body;
  Pose2 T_map_odom;
};
[[nodiscard]] std::string transforms_json(std::int64_t utime_us, const FoxgloveTransforms& transforms);

/// The map in one piece: percent occupied, -1 unknown. What is too large for one is made coarser.
/// `at_us`: as it was then; unset: the newest. nullopt: there is nothing of it.
[[nodiscard]] std::optional<std::string> grid_json(std::int64_t utime_us, const RunHistory& history,
                                                   std::optional<std::int64_t> at_us);

[[nodiscard]] std::string walls_json(std::int64_t utime_us, const std::vector<SeenWall>& walls);
/// Those found up to `utime_us`; those dropped by then are faint.
[[nodiscard]] std::string closures_json(std::int64_t utime_us, const RunHistory& history);

/// A stretch of both trails.
struct TrailStretch {
  std::uint32_t number = 0;                        ///< the same again replaces
  std::vector<std::array<double, 2>> corrected{};  ///< x, y in frame map, as published
  std::vector<std::array<double, 2>> odometry{};   ///< in frame odom
};
[[nodiscard]] std::string trail_json(std::int64_t utime_us, const TrailStretch& stretch);
/// From the body to the hits of that moment; `ranges_m` as TrailPose::ranges_m along each of `bearings_rad`,
/// or empty.
[[nodiscard]] std::string beams_json(std::int64_t utime_us, const std::vector<float>& bearings_rad,
                                     const std::vector<float>& ranges_m);
/// Removes what was drawn on the topic.
[[nodiscard]] std::string clear_scene_json(std::int64_t utime_us);

[[nodiscard]] std::string log_json(const RunEvent& event);
[[nodiscard]] std::string status_log_json(const RunStatus& status);

}  // namespace swiftlet

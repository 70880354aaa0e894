// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

namespace swiftlet {

// Where the messages of docs/lcm.md are published, without the prefix.
inline constexpr const char* kPoseChannel = "POSE";
inline constexpr const char* kPoseLocalChannel = "POSE_LOCAL";
inline constexpr const char* kPoseOdomChannel = "POSE_ODOM";
inline constexpr const char* kPose2dChannel = "POSE_2D";
inline constexpr const char* kPoseOdom2dChannel = "POSE_ODOM_2D";
inline constexpr const char* kRangesChannel = "RANGES";
inline constexpr const char* kMapInfoChannel = "MAP_INFO";
inline constexpr const char* kMapTileChannel = "MAP_TILE";
inline constexpr const char* kLandmarksChannel = "LANDMARKS";
inline constexpr const char* kLoopClosureChannel = "LOOP_CLOSURE";
inline constexpr const char* kVehicleEventChannel = "VEHICLE_EVENT";
inline constexpr const char* kStatusChannel = "STATUS";

}  // namespace swiftlet

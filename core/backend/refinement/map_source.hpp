// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <string_view>

namespace swiftlet {

/// What the final map follows; the simplest first.
enum class MapSource : std::uint8_t {
  kDeadReckoning,  ///< the odometry as reported
  kFrontend,       ///< the landmark graph: no loop closures
  kPoseGraph,
  kOtherYawNoise,  ///< the map of the run mapped again (OtherPath)
  kBackwards,      ///< likewise, from its end to its start
  kFloorKnown,     ///< likewise, once the floors had been found (FloorField)
};

/// Of the others no loop closure has moved a pose.
constexpr bool follows_closures(MapSource source) {
  return source != MapSource::kDeadReckoning && source != MapSource::kFrontend;
}

constexpr std::string_view name_of(MapSource source) {
  switch (source) {
    case MapSource::kDeadReckoning:
      return "dead reckoning";
    case MapSource::kFrontend:
      return "frontend";
    case MapSource::kOtherYawNoise:
      return "other yaw noise";
    case MapSource::kBackwards:
      return "backwards";
    case MapSource::kFloorKnown:
      return "floor known";
    case MapSource::kPoseGraph:
      break;
  }
  return "pose graph";
}

}  // namespace swiftlet

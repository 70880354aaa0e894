// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace swiftlet {

/// What is offered to Foxglove, in MCAP files and on its WebSocket (docs/foxglove.md).
enum class FoxgloveTopic : std::uint8_t {
  kTransforms,
  kPose,
  kPoseOdom,
  kMap,
  kWalls,
  kClosures,
  kTrail,
  kBeams,
  kLog,
  kStatus,
  kTrajectory,  ///< of a whole run alone: not on the WebSocket
};
inline constexpr std::size_t kFoxgloveTopics = 11;

/// A topic, whose messages are JSON. The id is its number, counted from 1.
struct FoxgloveChannel {
  std::uint16_t id = 0;
  std::string_view topic;        ///< "/pose"
  std::string_view schema_name;  ///< "foxglove.PoseInFrame"
  std::string schema;            ///< JSON schema
};

inline constexpr std::string_view kFoxgloveEncoding = "json";
inline constexpr std::string_view kFoxgloveSchemaEncoding = "jsonschema";

/// All of them, in the order of FoxgloveTopic.
[[nodiscard]] std::span<const FoxgloveChannel> foxglove_channels();
[[nodiscard]] constexpr std::uint16_t channel_id(FoxgloveTopic topic) {
  return static_cast<std::uint16_t>(static_cast<std::uint16_t>(topic) + 1);
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "daemon/view/conversation.hpp"
#include "daemon/view/run_history.hpp"

namespace swiftlet {

// What server and page say to each other on the WebSocket /live. The page's side is
// daemon/view/page/messages.js. Times are utime of docs/lcm.md, lengths metres, angles radians.
//
// From the server, as text: JSON objects told apart by "type".
//   run       a run begins: forget all before. generation, map_id (text), title, is_recording, rate
//   status    as of the moment that is looked at: the members of RunStatus
//   events    events: new ones, each with utime_us, level (0 note, 1 good, 2 warning, 3 bad), text
//   closures  closures: new and changed ones: the members of SeenClosure
//   storey    storey: the one that is shown from now on; 0 at the beginning. Forget walls and tiles
//   synced    everything up to the moment that is looked at has been sent. utime_us of that moment, 0: the
//   newest; has_ended: so has the run, whatever moment is looked at
// From the server, as bytes, little-endian: a header of 16 bytes (u32 kind, u32 count, f64 value), then
// `count` records:
//   1 poses, value n: number of beams. f32[n] bearings come before the records.
//     A record: f64 utime_us; f32[3] map, f32[3] local, f32[3] odom (x, y, yaw); i32 sequence, segment,
//     correction_version, tracking, storey; f32[6] covariance_map as in pose_t; f32[n] ranges as
//     TrailPose::ranges_m
//   2 walls, value utime_us: all of them: i32 id; f32[4] start x, y, end x, y
//   3 tiles, value resolution_m: i32 x, y, version; i8[4096] occupancy as in map_tile_t. Version 0: gone
// From the page, as text: {"at": utime_us} to look at the run as it was then, {"at": null} for the newest.

inline constexpr std::uint32_t kPosesKind = 1;
inline constexpr std::uint32_t kWallsKind = 2;
inline constexpr std::uint32_t kTilesKind = 3;

/// What is shown, for the title.
struct ShownSource {
  std::string title;          ///< the URL listened to, or the recording
  bool is_recording = false;  ///< to be played from its beginning
  double rate = 1.0;          ///< of a recording: at this many times its pace
};

[[nodiscard]] WebMessage run_message(const RunHistory& history, const ShownSource& source);
[[nodiscard]] WebMessage status_message(const RunStatus& status);
[[nodiscard]] WebMessage events_message(std::span<const RunEvent> events);
[[nodiscard]] WebMessage closures_message(std::span<const SeenClosure> closures);
[[nodiscard]] WebMessage storey_message(StoreyId storey);
[[nodiscard]] WebMessage synced_message(std::int64_t at_us, bool has_ended);
/// `bearings_rad` as RunHistory::bearings_rad().
[[nodiscard]] WebMessage poses_message(std::span<const TrailPose> poses, std::span<const float> bearings_rad);
[[nodiscard]] WebMessage walls_message(std::int64_t utime_us, std::span<const SeenWall> walls);

/// nullptr: a tile that was not there yet.
using TileAsOf = std::pair<TileIndex, const StoredTile*>;
[[nodiscard]] WebMessage tiles_message(double resolution_m, std::span<const TileAsOf> tiles);

/// What the page wants to look at.
struct MomentRequest {
  std::optional<std::int64_t> at_us;  ///< unset: the newest
};
/// nullopt when the text is no such request.
[[nodiscard]] std::optional<MomentRequest> parse_moment_request(std::string_view text);

}  // namespace swiftlet

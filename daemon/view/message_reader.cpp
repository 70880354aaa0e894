// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/message_reader.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>

#include "core/sensing/range_sample.hpp"
#include "daemon/publish/channel_names.hpp"
#include "daemon/publish/decoded_message.hpp"
#include "swiftlet/landmarks_t.hpp"
#include "swiftlet/loop_closure_t.hpp"
#include "swiftlet/map_tile_t.hpp"
#include "swiftlet/pose_t.hpp"
#include "swiftlet/ranges_t.hpp"
#include "swiftlet/status_t.hpp"
#include "swiftlet/vehicle_event_t.hpp"

namespace swiftlet {
namespace {

constexpr std::array<std::string_view, 9> kChannels{
    kPoseChannel,      kPoseLocalChannel,   kPoseOdomChannel,     kRangesChannel, kMapTileChannel,
    kLandmarksChannel, kLoopClosureChannel, kVehicleEventChannel, kStatusChannel};

constexpr std::size_t kMaxWalls = 100'000;
constexpr std::int32_t kMaxTileIndex = 1 << 20;
constexpr double kFarthestM = 1e7;
constexpr std::int64_t kLargest = std::int64_t{1} << 53;  // that a page's numbers hold; the year 2255

/// A count, or microseconds since 1970.
bool is_count(std::int64_t number) { return number >= 0 && number <= kLargest; }
bool is_place(double x_m, double y_m) { return std::abs(x_m) < kFarthestM && std::abs(y_m) < kFarthestM; }
bool is_place(const double (&point)[2]) { return is_place(point[0], point[1]); }
bool is_place(const float (&point)[2]) {
  return is_place(static_cast<double>(point[0]), static_cast<double>(point[1]));
}

bool is_storey(std::int8_t storey) { return storey >= 0 && storey < static_cast<int>(kMaxStoreys); }

bool is_sound(const pose_t& pose) {
  return is_storey(pose.storey) && is_place(pose.x, pose.y) && std::isfinite(pose.yaw);
}
bool is_sound(const ranges_t& ranges) {
  const auto is_length = [](float length_m) {
    return length_m >= 0.0F && length_m < static_cast<float>(kFarthestM);
  };
  return ranges.count > 0 && static_cast<std::size_t>(ranges.count) <= kMaxBeams &&
         std::all_of(ranges.distance.begin(), ranges.distance.end(), is_length) &&
         std::all_of(ranges.bearing.begin(), ranges.bearing.end(),
                     [](float bearing_rad) { return std::isfinite(bearing_rad); });
}
bool is_sound(const map_tile_t& tile) {
  return is_storey(tile.storey) && std::abs(tile.tile_x) < kMaxTileIndex &&
         std::abs(tile.tile_y) < kMaxTileIndex && tile.version > 0 && tile.resolution > 1e-3 &&
         tile.resolution < 10.0;
}
bool is_sound(const landmarks_t& walls) {
  return std::all_of(walls.landmarks.begin(), walls.landmarks.end(), [](const landmark_t& wall) {
    return is_storey(wall.storey) && is_place(wall.start) && is_place(wall.end);
  });
}
bool is_sound(const loop_closure_t& closure) {
  return is_storey(closure.storey) && is_place(closure.from_map) && is_place(closure.to_map) &&
         std::isfinite(closure.score);
}
bool is_sound(const vehicle_event_t& event) {
  return std::ranges::all_of(event.text, [](char c) { return c >= ' ' && c <= '~'; });
}
bool is_sound(const status_t& status) {
  const std::array counts{status.samples,          status.gaps,
                          status.missing_packets,  status.segments,
                          status.keyframes,        status.closures_accepted,
                          status.closures_dropped, status.missed_deadlines,
                          status.recorded_bytes};
  return std::all_of(counts.begin(), counts.end(), is_count) && std::isfinite(status.progress) &&
         std::isfinite(status.sample_rate) && std::isfinite(status.link.ack_rate) &&
         std::isfinite(status.link.round_trip_ms) && std::isfinite(status.link.battery_v);
}

double latency_p99_ms(const status_t& status) {
  const auto found = std::find_if(status.stages.begin(), status.stages.end(),
                                  [](const stage_time_t& stage) { return stage.name == "frame_to_pose"; });
  return found == status.stages.end() || found->count == 0 ? -1.0 : found->p99;
}

RunStatus run_status(const status_t& message) {
  return {.utime_us = message.utime,
          .state = message.state,
          .progress = message.progress,
          .sample_rate_hz = message.sample_rate,
          .samples = message.samples,
          .gaps = message.gaps,
          .missing_packets = message.missing_packets,
          .segments = message.segments,
          .keyframes = message.keyframes,
          .closures = message.closures_accepted - message.closures_dropped,
          .missed_deadlines = message.missed_deadlines,
          .latency_p99_ms = latency_p99_ms(message),
          .link_condition = message.link.condition,
          .ack_rate = message.link.ack_rate,
          .round_trip_ms = message.link.round_trip_ms,
          .rssi_dbm = message.link.rssi_dbm,
          .battery_v = message.link.battery_v,
          .flying = message.link.flying,
          .recording = message.recording,
          .recorded_bytes = message.recorded_bytes,
          .tile_count = message.tile_count,
          .version_sum = message.version_sum};
}

}  // namespace

std::span<const std::string_view> viewed_channels() { return kChannels; }

template <>
void MessageReader::add(const pose_t& message) {
  const std::array<double, 3> pose{message.x, message.y, message.yaw};
  if (message.frame == pose_t::FRAME_LOCAL) return history_.add_local(message.sequence, pose);
  if (message.frame == pose_t::FRAME_ODOM) return history_.add_odom(message.sequence, pose);
  const TrailPose trail_pose{.utime_us = message.utime,
                             .sequence = message.sequence,
                             .segment = message.segment,
                             .correction_version = message.correction_version,
                             .storey = message.storey,
                             .tracking = message.tracking,
                             .covariance = std::to_array(message.covariance_map),
                             .map = pose};
  narrator_.see_pose(trail_pose);
  history_.add_pose(trail_pose);
}

template <>
void MessageReader::add(const ranges_t& message) {
  constexpr float kNoMeasurement = -1.0F;
  std::vector<float> ranges_m = message.distance;
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    if (message.status[i] == ranges_t::STATUS_HIT) continue;
    ranges_m[i] = message.status[i] == ranges_t::STATUS_NO_RETURN ? 0.0F : kNoMeasurement;
  }
  history_.add_ranges(message.sequence, message.bearing, std::move(ranges_m));
}

template <>
void MessageReader::add(const map_tile_t& message) {
  MapTile tile{
      .index = {message.tile_x, message.tile_y, make_id<StoreyId>(static_cast<std::size_t>(message.storey))},
      .version = static_cast<std::uint32_t>(message.version)};
  std::memcpy(tile.occupancy_percent.data(), message.occupancy_percent, sizeof(message.occupancy_percent));
  history_.add_tile(message.utime, tile, message.resolution);
}

template <>
void MessageReader::add(const landmarks_t& message) {
  if (message.first == 0) walls_.clear();
  if (static_cast<std::size_t>(message.first) != walls_.size() || walls_.size() > kMaxWalls) return;
  for (const landmark_t& wall : message.landmarks)
    walls_.push_back({wall.id, {wall.start[0], wall.start[1]}, {wall.end[0], wall.end[1]}, wall.storey});
  if (walls_.size() == static_cast<std::size_t>(message.total)) history_.add_walls(message.utime, walls_);
}

template <>
void MessageReader::add(const loop_closure_t& message) {
  const SeenClosure closure{.index = message.index,
                            .from_keyframe = message.from_keyframe,
                            .to_keyframe = message.to_keyframe,
                            .from_map = {message.from_map[0], message.from_map[1]},
                            .to_map = {message.to_map[0], message.to_map[1]},
                            .storey = message.storey,
                            .score = message.score};
  const bool is_dropped = message.dropped != 0;
  narrator_.see_closure(closure, is_dropped, message.utime);
  history_.add_closure(closure, is_dropped, message.utime);
}

template <>
void MessageReader::add(const vehicle_event_t& message) {
  narrator_.see_event(message.text, message.utime);
}

template <>
void MessageReader::add(const status_t& message) {
  const RunStatus status = run_status(message);
  narrator_.see_status(status);
  history_.add_status(status);
}

template <typename Message>
void MessageReader::decode(std::span<const std::uint8_t> bytes, MonotonicTime now) {
  const std::optional<Message> message = decoded_message<Message>(bytes);
  if (!message || !is_count(message->utime) || !is_sound(*message)) return;
  const double silence_s = std::chrono::duration<double>(now - last_accepted_).count();
  if (!history_.enter_run(message->map_id, silence_s)) return;
  last_accepted_ = now;
  add(*message);
}

void MessageReader::take(std::string_view channel, std::span<const std::uint8_t> message, MonotonicTime now) {
  if (channel == kPoseChannel || channel == kPoseLocalChannel || channel == kPoseOdomChannel)
    return decode<pose_t>(message, now);
  if (channel == kRangesChannel) return decode<ranges_t>(message, now);
  if (channel == kMapTileChannel) return decode<map_tile_t>(message, now);
  if (channel == kLandmarksChannel) return decode<landmarks_t>(message, now);
  if (channel == kLoopClosureChannel) return decode<loop_closure_t>(message, now);
  if (channel == kVehicleEventChannel) return decode<vehicle_event_t>(message, now);
  if (channel == kStatusChannel) return decode<status_t>(message, now);
}

}  // namespace swiftlet

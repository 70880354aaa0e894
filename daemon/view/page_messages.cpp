// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/page_messages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <nlohmann/json.hpp>

namespace swiftlet {
namespace {

using nlohmann::json;

/// Numbers as bytes, little-endian.
class ByteWriter {
 public:
  ByteWriter(std::uint32_t kind, std::size_t count, double value, std::size_t record_bytes) {
    bytes_.reserve(16 + count * record_bytes);
    put(kind);
    put(static_cast<std::uint32_t>(count));
    put(value);
  }

  template <typename Number>
  void put(Number number) {
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), &number, raw.size());
    if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
    bytes_.append(raw.data(), raw.size());
  }
  void put_f32(double number) { put(static_cast<float>(number)); }
  void put_pose(const std::array<double, 3>& pose) {
    for (const double part : pose) put_f32(part);
  }
  void put_cells(const std::array<std::int8_t, kCellsInTile>& cells) {
    for (const std::int8_t cell : cells) bytes_.push_back(static_cast<char>(cell));
  }
  [[nodiscard]] WebMessage message() && { return {.is_text = false, .bytes = std::move(bytes_)}; }

 private:
  std::string bytes_;
};

// Foreign bytes (a file's name in the title) need not be UTF-8.
WebMessage page_message(const json& content) {
  return {.is_text = true, .bytes = content.dump(-1, ' ', false, json::error_handler_t::replace)};
}

void put_record(ByteWriter& out, const TrailPose& pose, std::size_t beams) {
  constexpr float kUnknown = -1.0F;
  out.put(static_cast<double>(pose.utime_us));
  out.put_pose(pose.map);
  out.put_pose(pose.local);
  out.put_pose(pose.odom);
  out.put(pose.sequence);
  out.put(pose.segment);
  out.put(pose.correction_version);
  out.put(std::int32_t{pose.tracking});
  out.put(std::int32_t{pose.storey});
  for (const double entry : pose.covariance) out.put_f32(entry);
  for (std::size_t i = 0; i < beams; ++i) out.put(i < pose.ranges_m.size() ? pose.ranges_m[i] : kUnknown);
}

}  // namespace

WebMessage run_message(const RunHistory& history, const ShownSource& source) {
  return page_message({{"type", "run"},
                       {"generation", history.generation()},
                       {"map_id", std::to_string(history.map_id())},
                       {"title", source.title},
                       {"is_recording", source.is_recording},
                       {"rate", source.rate}});
}

WebMessage status_message(const RunStatus& status) {
  return page_message({{"type", "status"},
                       {"utime_us", status.utime_us},
                       {"state", status.state},
                       {"progress", status.progress},
                       {"sample_rate_hz", status.sample_rate_hz},
                       {"samples", status.samples},
                       {"gaps", status.gaps},
                       {"missing_packets", status.missing_packets},
                       {"segments", status.segments},
                       {"keyframes", status.keyframes},
                       {"closures", status.closures},
                       {"missed_deadlines", status.missed_deadlines},
                       {"latency_p99_ms", status.latency_p99_ms},
                       {"link_condition", status.link_condition},
                       {"ack_rate", status.ack_rate},
                       {"round_trip_ms", status.round_trip_ms},
                       {"rssi_dbm", status.rssi_dbm},
                       {"battery_v", status.battery_v},
                       {"flying", status.flying},
                       {"recording", status.recording},
                       {"recorded_bytes", status.recorded_bytes},
                       {"tile_count", status.tile_count},
                       {"version_sum", status.version_sum}});
}

WebMessage events_message(std::span<const RunEvent> events) {
  json list = json::array();
  for (const RunEvent& event : events)
    list.push_back(
        {{"utime_us", event.utime_us}, {"level", static_cast<int>(event.level)}, {"text", event.text}});
  return page_message({{"type", "events"}, {"events", std::move(list)}});
}

WebMessage closures_message(std::span<const SeenClosure> closures) {
  json list = json::array();
  for (const SeenClosure& closure : closures)
    list.push_back({{"index", closure.index},
                    {"found_us", closure.found_us},
                    {"dropped_us", closure.dropped_us},
                    {"from_keyframe", closure.from_keyframe},
                    {"to_keyframe", closure.to_keyframe},
                    {"from_map", closure.from_map},
                    {"to_map", closure.to_map},
                    {"storey", closure.storey},
                    {"score", closure.score}});
  return page_message({{"type", "closures"}, {"closures", std::move(list)}});
}

WebMessage storey_message(StoreyId storey) {
  return page_message({{"type", "storey"}, {"storey", index_of(storey)}});
}

WebMessage synced_message(std::int64_t at_us, bool has_ended) {
  return page_message({{"type", "synced"}, {"utime_us", at_us}, {"has_ended", has_ended}});
}

WebMessage poses_message(std::span<const TrailPose> poses, std::span<const float> bearings_rad) {
  constexpr std::size_t kRecordBytes = 88;
  const std::size_t beams = bearings_rad.size();
  ByteWriter out(kPosesKind, poses.size(), static_cast<double>(beams), kRecordBytes + beams * sizeof(float));
  for (const float bearing : bearings_rad) out.put(bearing);
  for (const TrailPose& pose : poses) put_record(out, pose, beams);
  return std::move(out).message();
}

WebMessage walls_message(std::int64_t utime_us, std::span<const SeenWall> walls) {
  constexpr std::size_t kRecordBytes = 20;
  ByteWriter out(kWallsKind, walls.size(), static_cast<double>(utime_us), kRecordBytes);
  for (const SeenWall& wall : walls) {
    out.put(wall.id);
    for (const float part : wall.start) out.put(part);
    for (const float part : wall.end) out.put(part);
  }
  return std::move(out).message();
}

WebMessage tiles_message(double resolution_m, std::span<const TileAsOf> tiles) {
  ByteWriter out(kTilesKind, tiles.size(), resolution_m, 12 + kCellsInTile);
  for (const auto& [index, tile] : tiles) {
    out.put(index.x);
    out.put(index.y);
    out.put(tile == nullptr ? 0U : tile->version);
    out.put_cells(inflate_tile(tile == nullptr ? std::span<const std::uint8_t>() : tile->deflated));
  }
  return std::move(out).message();
}

std::optional<MomentRequest> parse_moment_request(std::string_view text) {
  const json request = json::parse(text, nullptr, false);
  if (!request.is_object()) return std::nullopt;
  const auto at = request.find("at");
  if (at == request.end()) return std::nullopt;
  if (at->is_null()) return MomentRequest{};
  if (!at->is_number_integer()) return std::nullopt;
  return MomentRequest{.at_us = at->get<std::int64_t>()};
}

}  // namespace swiftlet

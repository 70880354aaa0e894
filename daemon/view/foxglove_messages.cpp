// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/foxglove_messages.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "daemon/view/map_image.hpp"
#include "swiftlet/status_t.hpp"

namespace swiftlet {
namespace {

using Json = nlohmann::ordered_json;
using Points = std::vector<std::array<double, 2>>;

constexpr std::string_view kMapFrame = "map";
constexpr std::string_view kLocalFrame = "local";
constexpr std::string_view kOdomFrame = "odom";
constexpr std::string_view kBodyFrame = "body";

constexpr int kLineStrip = 0;  // of foxglove.LinePrimitive
constexpr int kLineList = 2;
constexpr int kInt8 = 2;       // of foxglove.PackedElementField
constexpr int kDeleteAll = 1;  // of foxglove.SceneEntityDeletion
constexpr int kInfo = 2;       // of foxglove.Log
constexpr int kWarning = 3;
constexpr int kError = 4;

constexpr double kTrailAboveM = 0.02;  // drawn above the grid
constexpr double kWallAboveM = 0.01;
constexpr double kDigits = 1e4;  // of points that are drawn: a tenth of a millimetre

struct Color {
  double r, g, b, a;
};
constexpr Color kWallColor{0.1, 0.1, 0.1, 1.0};
constexpr Color kClosureColor{0.1, 0.6, 0.2, 0.6};
constexpr Color kDroppedColor{0.8, 0.2, 0.2, 0.25};
constexpr Color kCorrectedColor{0.0, 0.35, 0.8, 1.0};
constexpr Color kBeamColor{0.88, 0.33, 0.12, 0.7};
constexpr Color kOdometryColor{0.85, 0.45, 0.0, 0.8};

// Foreign bytes need not be UTF-8.
std::string text_of(const Json& content) {
  return content.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json time_json(std::int64_t utime_us) {
  constexpr std::int64_t kMicroseconds = 1'000'000;
  const std::int64_t since_1970_us = std::max<std::int64_t>(utime_us, 0);
  return {{"sec", since_1970_us / kMicroseconds}, {"nsec", since_1970_us % kMicroseconds * 1000}};
}
Json vector_json(double x, double y, double z = 0.0) { return {{"x", x}, {"y", y}, {"z", z}}; }
Json rotation_json(double yaw_rad) {
  return {{"x", 0.0}, {"y", 0.0}, {"z", std::sin(yaw_rad / 2.0)}, {"w", std::cos(yaw_rad / 2.0)}};
}
Json pose_json(const Pose2& pose) {
  return {{"position", vector_json(pose.x_m(), pose.y_m())}, {"orientation", rotation_json(pose.yaw_rad())}};
}
Json color_json(const Color& color) {
  return {{"r", color.r}, {"g", color.g}, {"b", color.b}, {"a", color.a}};
}

Json transform_json(const Json& time, std::string_view parent, std::string_view child,
                    const Pose2& T_parent_child) {
  return {{"timestamp", time},
          {"parent_frame_id", parent},
          {"child_frame_id", child},
          {"translation", vector_json(T_parent_child.x_m(), T_parent_child.y_m())},
          {"rotation", rotation_json(T_parent_child.yaw_rad())}};
}

double drawn(double metres) { return std::round(metres * kDigits) / kDigits; }

Json lines_json(int type, const Points& points, double z_m, const Color& color) {
  Json list = Json::array();
  for (const auto& [x_m, y_m] : points) list.push_back(vector_json(drawn(x_m), drawn(y_m), z_m));
  return {{"type", type},
          {"pose", pose_json(Pose2())},
          {"thickness", 2.0},
          {"scale_invariant", true},
          {"points", std::move(list)},
          {"color", color_json(color)},
          {"colors", Json::array()},
          {"indices", Json::array()}};
}

Json entity_json(std::int64_t utime_us, std::string_view frame, const std::string& id, Json lines) {
  const Json none = Json::array();
  return {{"timestamp", time_json(utime_us)},
          {"frame_id", frame},
          {"id", id},
          {"lifetime", {{"sec", 0}, {"nsec", 0}}},
          {"frame_locked", true},
          {"metadata", none},
          {"arrows", none},
          {"cubes", none},
          {"spheres", none},
          {"cylinders", none},
          {"lines", std::move(lines)},
          {"triangles", none},
          {"texts", none},
          {"models", none}};
}

std::string scene_of(Json entities) {
  return text_of({{"deletions", Json::array()}, {"entities", std::move(entities)}});
}

std::string message_json(std::int64_t utime_us, int level, std::string_view text) {
  return text_of({{"timestamp", time_json(utime_us)},
                  {"level", level},
                  {"message", text},
                  {"name", "swiftlet"},
                  {"file", ""},
                  {"line", 0}});
}

int log_level(EventLevel level) {
  if (level == EventLevel::kBad) return kError;
  return level == EventLevel::kWarning ? kWarning : kInfo;
}

const char* state_text(std::int8_t state) {
  if (state == status_t::STATE_FINISHED) return "finished";
  return state == status_t::STATE_FINISHING ? "finishing" : "running";
}

}  // namespace

std::string pose_in_frame_json(std::int64_t utime_us, std::string_view frame, const Pose2& pose) {
  return text_of({{"timestamp", time_json(utime_us)}, {"frame_id", frame}, {"pose", pose_json(pose)}});
}

std::string transforms_json(std::int64_t utime_us, const FoxgloveTransforms& transforms) {
  const Json time = time_json(utime_us);
  return text_of({{"transforms",
                   {transform_json(time, kMapFrame, kLocalFrame, transforms.T_map_local),
                    transform_json(time, kLocalFrame, kBodyFrame, transforms.T_local_body),
                    transform_json(time, kMapFrame, kOdomFrame, transforms.T_map_odom)}}});
}

std::optional<std::string> grid_json(std::int64_t utime_us, const RunHistory& history,
                                     std::optional<std::int64_t> at_us) {
  const std::optional<MapImage> image = map_image(history, at_us);
  if (!image) return std::nullopt;
  const Json field{{"name", "occupancy"}, {"offset", 0}, {"type", kInt8}};
  return text_of({{"timestamp", time_json(utime_us)},
                  {"frame_id", kMapFrame},
                  {"pose", pose_json(Pose2(image->left_m, image->bottom_m, 0.0))},
                  {"column_count", image->columns},
                  {"cell_size", {{"x", image->cell_m}, {"y", image->cell_m}}},
                  {"row_stride", image->columns},
                  {"cell_stride", 1},
                  {"fields", Json::array({field})},
                  {"data", base64(image->occupancy_percent)}});
}

std::string walls_json(std::int64_t utime_us, const std::vector<SeenWall>& walls) {
  Points points;
  for (const SeenWall& wall : walls) {
    points.push_back({static_cast<double>(wall.start[0]), static_cast<double>(wall.start[1])});
    points.push_back({static_cast<double>(wall.end[0]), static_cast<double>(wall.end[1])});
  }
  Json lines = Json::array({lines_json(kLineList, points, kWallAboveM, kWallColor)});
  return scene_of(Json::array({entity_json(utime_us, kMapFrame, "walls", std::move(lines))}));
}

std::string closures_json(std::int64_t utime_us, const RunHistory& history) {
  Points believed;
  Points dropped;
  const auto storey = static_cast<std::int8_t>(index_of(history.storey_at(utime_us)));
  for (const auto& [index, numbered] : history.closures()) {
    const SeenClosure& closure = numbered.closure;
    if (closure.found_us > utime_us || closure.storey != storey) continue;
    const bool is_dropped = closure.dropped_us != 0 && closure.dropped_us <= utime_us;
    Points& points = is_dropped ? dropped : believed;
    points.push_back(closure.from_map);
    points.push_back(closure.to_map);
  }
  Json lines = Json::array({lines_json(kLineList, believed, kTrailAboveM, kClosureColor),
                            lines_json(kLineList, dropped, kTrailAboveM, kDroppedColor)});
  return scene_of(Json::array({entity_json(utime_us, kMapFrame, "closures", std::move(lines))}));
}

std::string trail_json(std::int64_t utime_us, const TrailStretch& stretch) {
  const auto entity = [&](std::string_view frame, const std::string& name, const Points& points,
                          const Color& color) {
    return entity_json(utime_us, frame, name + " " + std::to_string(stretch.number),
                       Json::array({lines_json(kLineStrip, points, kTrailAboveM, color)}));
  };
  return scene_of(Json::array({entity(kMapFrame, "corrected", stretch.corrected, kCorrectedColor),
                               entity(kOdomFrame, "odometry", stretch.odometry, kOdometryColor)}));
}

std::string beams_json(std::int64_t utime_us, const std::vector<float>& bearings_rad,
                       const std::vector<float>& ranges_m) {
  Points points;
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    if (!(ranges_m[i] > 0.0F)) continue;
    const auto range_m = static_cast<double>(ranges_m[i]);
    const auto bearing_rad = static_cast<double>(bearings_rad[i]);
    points.push_back({0.0, 0.0});
    points.push_back({range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad)});
  }
  Json lines = Json::array({lines_json(kLineList, points, kTrailAboveM, kBeamColor)});
  return scene_of(Json::array({entity_json(utime_us, kBodyFrame, "beams", std::move(lines))}));
}

std::string clear_scene_json(std::int64_t utime_us) {
  const Json all{{"timestamp", time_json(utime_us)}, {"type", kDeleteAll}, {"id", ""}};
  return text_of({{"deletions", Json::array({all})}, {"entities", Json::array()}});
}

std::string log_json(const RunEvent& event) {
  return message_json(event.utime_us, log_level(event.level), event.text);
}

std::string status_log_json(const RunStatus& status) {
  std::string text =
      fmt::format("{}: {} samples, {} keyframes, {} closures, {} packets missing", state_text(status.state),
                  status.samples, status.keyframes, status.closures, status.missing_packets);
  if (status.battery_v > 0.0) text += fmt::format(", battery {:.2f} V", status.battery_v);
  return message_json(status.utime_us, kInfo, text);
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/foxglove_channels.hpp"

#include <array>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <utility>

namespace swiftlet {
namespace {

using Json = nlohmann::ordered_json;

// JSON schemas of the messages, as far as they are sent; names and types are Foxglove's.

Json typed(std::string_view type) { return {{"type", type}}; }
Json number() { return typed("number"); }
Json integer() { return typed("integer"); }
Json text() { return typed("string"); }
Json boolean() { return typed("boolean"); }
Json bytes() { return {{"type", "string"}, {"contentEncoding", "base64"}}; }
Json array_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }

using Member = std::pair<std::string_view, Json>;
Json object(std::string_view title, std::initializer_list<Member> members) {
  Json schema{{"title", title}, {"type", "object"}, {"properties", Json::object()}};
  for (const auto& [name, member] : members) schema["properties"][std::string(name)] = member;
  return schema;
}

Json time() { return object("time", {{"sec", integer()}, {"nsec", integer()}}); }
Json duration() { return object("duration", {{"sec", integer()}, {"nsec", integer()}}); }
Json vector2() { return object("foxglove.Vector2", {{"x", number()}, {"y", number()}}); }
Json with_xyz(std::string_view title) {
  return object(title, {{"x", number()}, {"y", number()}, {"z", number()}});
}
Json vector3() { return with_xyz("foxglove.Vector3"); }
Json quaternion() {
  return object("foxglove.Quaternion", {{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}});
}
Json pose() { return object("foxglove.Pose", {{"position", vector3()}, {"orientation", quaternion()}}); }
Json color() {
  return object("foxglove.Color", {{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}});
}

Json pose_in_frame() {
  return object("foxglove.PoseInFrame", {{"timestamp", time()}, {"frame_id", text()}, {"pose", pose()}});
}

Json frame_transforms() {
  const Json transform = object("foxglove.FrameTransform", {{"timestamp", time()},
                                                            {"parent_frame_id", text()},
                                                            {"child_frame_id", text()},
                                                            {"translation", vector3()},
                                                            {"rotation", quaternion()}});
  return object("foxglove.FrameTransforms", {{"transforms", array_of(transform)}});
}

Json grid() {
  const Json field =
      object("foxglove.PackedElementField", {{"name", text()}, {"offset", integer()}, {"type", integer()}});
  return object("foxglove.Grid", {{"timestamp", time()},
                                  {"frame_id", text()},
                                  {"pose", pose()},
                                  {"column_count", integer()},
                                  {"cell_size", vector2()},
                                  {"row_stride", integer()},
                                  {"cell_stride", integer()},
                                  {"fields", array_of(field)},
                                  {"data", bytes()}});
}

Json line_primitive() {
  return object("foxglove.LinePrimitive", {{"type", integer()},
                                           {"pose", pose()},
                                           {"thickness", number()},
                                           {"scale_invariant", boolean()},
                                           {"points", array_of(with_xyz("foxglove.Point3"))},
                                           {"color", color()},
                                           {"colors", array_of(color())},
                                           {"indices", array_of(integer())}});
}

/// Lists of an entity that are always empty need no schema of their items.
Json scene_update() {
  const Json deletion =
      object("foxglove.SceneEntityDeletion", {{"timestamp", time()}, {"type", integer()}, {"id", text()}});
  const Json none = array_of(typed("object"));
  const Json entity = object("foxglove.SceneEntity", {{"timestamp", time()},
                                                      {"frame_id", text()},
                                                      {"id", text()},
                                                      {"lifetime", duration()},
                                                      {"frame_locked", boolean()},
                                                      {"metadata", none},
                                                      {"arrows", none},
                                                      {"cubes", none},
                                                      {"spheres", none},
                                                      {"cylinders", none},
                                                      {"lines", array_of(line_primitive())},
                                                      {"triangles", none},
                                                      {"texts", none},
                                                      {"models", none}});
  return object("foxglove.SceneUpdate", {{"deletions", array_of(deletion)}, {"entities", array_of(entity)}});
}

Json log() {
  return object("foxglove.Log", {{"timestamp", time()},
                                 {"level", integer()},
                                 {"message", text()},
                                 {"name", text()},
                                 {"file", text()},
                                 {"line", integer()}});
}

FoxgloveChannel channel(FoxgloveTopic topic, std::string_view name, std::string_view schema_name,
                        const Json& schema) {
  return {.id = channel_id(topic), .topic = name, .schema_name = schema_name, .schema = schema.dump()};
}

std::array<FoxgloveChannel, kFoxgloveTopics> make_channels() {
  constexpr std::string_view kPose = "foxglove.PoseInFrame";
  constexpr std::string_view kScene = "foxglove.SceneUpdate";
  constexpr std::string_view kLog = "foxglove.Log";
  return {channel(FoxgloveTopic::kTransforms, "/tf", "foxglove.FrameTransforms", frame_transforms()),
          channel(FoxgloveTopic::kPose, "/pose", kPose, pose_in_frame()),
          channel(FoxgloveTopic::kPoseOdom, "/pose_odom", kPose, pose_in_frame()),
          channel(FoxgloveTopic::kMap, "/map", "foxglove.Grid", grid()),
          channel(FoxgloveTopic::kWalls, "/walls", kScene, scene_update()),
          channel(FoxgloveTopic::kClosures, "/closures", kScene, scene_update()),
          channel(FoxgloveTopic::kTrail, "/trail", kScene, scene_update()),
          channel(FoxgloveTopic::kBeams, "/beams", kScene, scene_update()),
          channel(FoxgloveTopic::kLog, "/log", kLog, log()),
          channel(FoxgloveTopic::kStatus, "/status", kLog, log()),
          channel(FoxgloveTopic::kTrajectory, "/trajectory", kPose, pose_in_frame())};
}

}  // namespace

std::span<const FoxgloveChannel> foxglove_channels() {
  static const std::array<FoxgloveChannel, kFoxgloveTopics> kChannels = make_channels();
  return kChannels;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/foxglove_feed.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet {
namespace {

constexpr std::size_t kStretchPoints = 200;
constexpr double kTrailStepM = 0.05;  // what is nearer is left out

Pose2 pose_of(const std::array<double, 3>& pose) { return {pose[0], pose[1], pose[2]}; }

FoxgloveTransforms transforms_of(const TrailPose& first, const TrailPose& pose) {
  const Pose2 T_local_body = pose_of(pose.local);
  return {.T_map_local = pose_of(pose.map) * T_local_body.inverse(),
          .T_local_body = T_local_body,
          .T_map_odom = pose_of(first.map) * pose_of(first.odom).inverse()};
}

/// Beyond what else makes a content.
std::uint64_t content_of_storey(StoreyId storey) { return std::uint64_t{index_of(storey)} << 48U; }

/// Changes when the tiles of the storey that is looked at do, and with the storey.
std::uint64_t content_of_tiles(const RunHistory& history, std::optional<std::int64_t> at_us) {
  const StoreyId storey = history.storey_at(at_us);
  std::uint64_t versions = content_of_storey(storey);
  for (const auto& [index, tiles] : history.tiles()) {
    if (index.storey != storey) continue;
    const auto* const entry = at_us ? tiles.at(*at_us) : tiles.newest();
    if (entry != nullptr) versions += entry->value.version;
  }
  return versions;
}

std::uint64_t content_of_closures(const RunHistory& history, std::int64_t now_us) {
  std::uint64_t seen = content_of_storey(history.storey_at(now_us));
  for (const auto& [index, numbered] : history.closures()) {
    const SeenClosure& closure = numbered.closure;
    if (closure.found_us <= now_us) ++seen;
    if (closure.dropped_us != 0 && closure.dropped_us <= now_us) ++seen;
  }
  return seen;
}

}  // namespace

void FoxgloveFeed::begin(FoxgloveTopic topic) {
  stream(topic) = Stream{.is_wanted = true};
  if (topic == FoxgloveTopic::kTrail) stretch_ = {};
}

void FoxgloveFeed::hurry() {
  for (Stream& stream : streams_) stream.due_us = 0;
}

void FoxgloveFeed::begin_run(const RunHistory& history) {
  for (Stream& stream : streams_)
    stream = Stream{.is_wanted = stream.is_wanted, .must_clear = generation_ != 0};
  generation_ = history.generation();
  stretch_ = {};
}

std::optional<FoxgloveMessage> FoxgloveFeed::next(const RunHistory& history,
                                                  std::optional<std::int64_t> at_us) {
  if (history.generation() == 0) return std::nullopt;
  if (history.generation() != generation_) begin_run(history);
  const std::span<const TrailPose> poses = history.poses_after(0);
  if (poses.empty()) return std::nullopt;
  at_us_ = at_us;
  first_us_ = poses.front().utime_us;
  now_us_ = poses.back().utime_us;
  if (at_us) now_us_ = std::min(now_us_, *at_us);
  for (std::size_t i = 0; i < kFoxgloveTopics; ++i) {
    const auto topic = static_cast<FoxgloveTopic>(turn_);
    turn_ = (turn_ + 1) % kFoxgloveTopics;
    if (!stream(topic).is_wanted) continue;
    if (auto message = next_of(topic, history)) return message;
  }
  return std::nullopt;
}

std::optional<FoxgloveMessage> FoxgloveFeed::next_of(FoxgloveTopic topic, const RunHistory& history) {
  switch (topic) {
    case FoxgloveTopic::kTransforms:
    case FoxgloveTopic::kPose:
    case FoxgloveTopic::kPoseOdom:
    case FoxgloveTopic::kBeams:
      return pose_message(topic, history);
    case FoxgloveTopic::kLog:
      return log_message(history);
    case FoxgloveTopic::kStatus:
      return status_message_of(history);
    case FoxgloveTopic::kTrajectory:
      return std::nullopt;
    case FoxgloveTopic::kMap:
    case FoxgloveTopic::kWalls:
    case FoxgloveTopic::kClosures:
    case FoxgloveTopic::kTrail:
      break;
  }
  Text text = next_drawn(topic, history);
  if (!text) return std::nullopt;
  return FoxgloveMessage{.topic = topic, .utime_us = now_us_, .json = std::move(*text)};
}

FoxgloveFeed::Text FoxgloveFeed::next_drawn(FoxgloveTopic topic, const RunHistory& history) {
  Stream& drawn = stream(topic);
  if (std::exchange(drawn.must_clear, false) && topic != FoxgloveTopic::kMap)
    return clear_scene_json(now_us_);
  if (topic == FoxgloveTopic::kTrail) return trail_text(history);
  if (now_us_ < drawn.due_us) return std::nullopt;
  Text text = topic == FoxgloveTopic::kMap     ? map_text(history)
              : topic == FoxgloveTopic::kWalls ? walls_text(history)
                                               : closures_text(history);
  if (text) postpone(drawn, *text);
  return text;
}

void FoxgloveFeed::postpone(Stream& drawn, const std::string& text) const {
  const auto duration_us =
      static_cast<std::int64_t>(static_cast<double>(text.size()) / pace_.bytes_per_s * 1e6);
  drawn.due_us = now_us_ + std::max(pace_.period_us, duration_us);
}

/// The next to be told behind that of serial `after`.
const TrailPose* FoxgloveFeed::next_pose(const RunHistory& history, std::uint32_t after) const {
  const std::span<const TrailPose> poses = history.poses_after(after);
  return poses.empty() || (at_us_ && poses.front().utime_us > *at_us_) ? nullptr : &poses.front();
}

std::optional<FoxgloveMessage> FoxgloveFeed::pose_message(FoxgloveTopic topic, const RunHistory& history) {
  Stream& poses = stream(topic);
  if (topic == FoxgloveTopic::kBeams && std::exchange(poses.must_clear, false))
    return FoxgloveMessage{.topic = topic, .utime_us = now_us_, .json = clear_scene_json(now_us_)};
  const TrailPose* pose = next_pose(history, poses.serial);
  if (pose == nullptr) return std::nullopt;
  if (!at_us_ && history.poses_after(poses.serial).size() > pace_.max_waiting)
    pose = &history.poses_after(poses.serial).back();
  poses.serial = pose->serial;
  FoxgloveMessage message{.topic = topic, .utime_us = pose->utime_us, .json = {}};
  if (topic == FoxgloveTopic::kPose)
    message.json = pose_in_frame_json(pose->utime_us, "map", pose_of(pose->map));
  else if (topic == FoxgloveTopic::kPoseOdom)
    message.json = pose_in_frame_json(pose->utime_us, "odom", pose_of(pose->odom));
  else if (topic == FoxgloveTopic::kBeams)
    message.json = beams_json(pose->utime_us, history.bearings_rad(), pose->ranges_m);
  else
    message.json = transforms_json(pose->utime_us, transforms_of(history.poses_after(0).front(), *pose));
  return message;
}

std::optional<FoxgloveMessage> FoxgloveFeed::log_message(const RunHistory& history) {
  Stream& log = stream(FoxgloveTopic::kLog);
  const std::span<const RunEvent> events = history.events_after(log.serial);
  if (events.empty() || (at_us_ && events.front().utime_us > *at_us_)) return std::nullopt;
  RunEvent event = events.front();
  log.serial = event.serial;
  event.utime_us = std::max(event.utime_us, first_us_);
  return FoxgloveMessage{.topic = FoxgloveTopic::kLog, .utime_us = event.utime_us, .json = log_json(event)};
}

std::optional<FoxgloveMessage> FoxgloveFeed::status_message_of(const RunHistory& history) {
  Stream& status = stream(FoxgloveTopic::kStatus);
  const auto* const entry = at_us_ ? history.statuses().at(*at_us_) : history.statuses().newest();
  if (entry == nullptr || entry->serial == status.serial) return std::nullopt;
  status.serial = entry->serial;
  RunStatus told = entry->value;
  told.utime_us = std::max(told.utime_us, first_us_);
  return FoxgloveMessage{
      .topic = FoxgloveTopic::kStatus, .utime_us = told.utime_us, .json = status_log_json(told)};
}

FoxgloveFeed::Text FoxgloveFeed::map_text(const RunHistory& history) {
  Stream& map = stream(FoxgloveTopic::kMap);
  const std::uint64_t content = content_of_tiles(history, at_us_);
  if (std::exchange(map.content, content) == content) return std::nullopt;
  return grid_json(now_us_, history, at_us_);
}

FoxgloveFeed::Text FoxgloveFeed::walls_text(const RunHistory& history) {
  Stream& walls = stream(FoxgloveTopic::kWalls);
  const auto* const entry = at_us_ ? history.walls().at(*at_us_) : history.walls().newest();
  const StoreyId storey = history.storey_at(at_us_);
  if (entry == nullptr || (entry->serial == walls.serial && walls.content == index_of(storey)))
    return std::nullopt;
  walls.serial = entry->serial;
  walls.content = index_of(storey);
  return walls_json(now_us_, history.walls_at(at_us_, storey));
}

FoxgloveFeed::Text FoxgloveFeed::closures_text(const RunHistory& history) {
  Stream& closures = stream(FoxgloveTopic::kClosures);
  const std::uint64_t content = content_of_closures(history, now_us_);
  if (std::exchange(closures.content, content) == content) return std::nullopt;
  return closures_json(now_us_, history);
}

/// False: the pose begins another stretch.
bool FoxgloveFeed::extend_stretch(const TrailPose& pose) {
  if (!stretch_.corrected.empty() && pose.segment != stretch_segment_) return false;
  stretch_segment_ = pose.segment;
  const auto is_new = [](const auto& points, const std::array<double, 3>& at) {
    return points.empty() || std::hypot(at[0] - points.back()[0], at[1] - points.back()[1]) >= kTrailStepM;
  };
  if (!is_new(stretch_.corrected, pose.map) && !is_new(stretch_.odometry, pose.odom)) return true;
  stretch_.corrected.push_back({pose.map[0], pose.map[1]});
  stretch_.odometry.push_back({pose.odom[0], pose.odom[1]});
  stretch_has_news_ = true;
  return true;
}

/// A whole stretch at once, the newest in its time.
FoxgloveFeed::Text FoxgloveFeed::trail_text(const RunHistory& history) {
  Stream& trail = stream(FoxgloveTopic::kTrail);
  while (const TrailPose* pose = next_pose(history, trail.serial)) {
    const bool goes_on = extend_stretch(*pose);
    if (goes_on) trail.serial = pose->serial;
    if (goes_on && stretch_.corrected.size() < kStretchPoints) continue;
    const TrailStretch whole = std::exchange(stretch_, {.number = stretch_.number + 1});
    if (goes_on) {
      stretch_.corrected.push_back(whole.corrected.back());
      stretch_.odometry.push_back(whole.odometry.back());
    }
    stretch_has_news_ = false;
    return trail_json(now_us_, whole);
  }
  if (now_us_ < trail.due_us || !std::exchange(stretch_has_news_, false)) return std::nullopt;
  std::string text = trail_json(now_us_, stretch_);
  postpone(trail, text);
  return text;
}

}  // namespace swiftlet

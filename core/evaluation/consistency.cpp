// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/evaluation/consistency.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

ConsistencyAt compare(const DoubtedPose& pose, const Pose2& T_map_true) {
  const Eigen::Vector3d error(pose.T_map_body.x_m() - T_map_true.x_m(),
                              pose.T_map_body.y_m() - T_map_true.y_m(),
                              wrap_angle(pose.T_map_body.yaw_rad() - T_map_true.yaw_rad()));
  const Eigen::Matrix3d P = pose.from_start.matrix();
  return {.path_m = pose.path_m,
          .nees = error.dot(P.inverse() * error),
          .error_m = error.head<2>().norm(),
          .sigma_m = std::sqrt(P(0, 0) + P(1, 1)),
          .error_yaw_rad = std::abs(error.z()),
          .sigma_yaw_rad = std::sqrt(P(2, 2))};
}

/// A stretch in which the pose was not held for right.
struct Alarm {
  HostTime begin{};
  HostTime end{};
};
std::vector<Alarm> alarms_of(std::span<const DoubtedPose> poses) {
  std::vector<Alarm> alarms;
  bool was_tracked = true;
  for (const DoubtedPose& pose : poses) {
    if (!pose.is_tracked && was_tracked) alarms.push_back({pose.stamp, pose.stamp});
    if (!was_tracked) alarms.back().end = pose.stamp;
    was_tracked = pose.is_tracked;
  }
  return alarms;
}

/// Nothing where no place was known.
std::optional<bool> is_false(const Alarm& alarm, std::span<const StampedError> errors,
                             const AlarmTuning& tuning) {
  const HostTime since = alarm.begin - from_seconds(tuning.grace_s);
  bool is_known = false;
  for (const StampedError& e : errors) {
    if (e.stamp < since || e.stamp > alarm.end) continue;
    if (e.error_m > tuning.right_m) return false;
    is_known = true;
  }
  return is_known ? std::optional(true) : std::nullopt;
}

/// From the error's passing off_m until it is below right_m again.
std::vector<Alarm> times_off(std::span<const StampedError> errors, const AlarmTuning& tuning) {
  std::vector<Alarm> times;
  bool is_off = false;
  for (const StampedError& e : errors) {
    if (is_off) times.back().end = e.stamp;
    if (!is_off && e.error_m > tuning.off_m) times.push_back({e.stamp, e.stamp});
    is_off = is_off ? e.error_m >= tuning.right_m : e.error_m > tuning.off_m;
  }
  return times;
}

}  // namespace

std::array<std::optional<ConsistencyAt>, kConsistencyDistancesM.size()> consistency(
    std::span<const DoubtedPose> poses, const StampedPath& T_world_body) {
  std::array<std::optional<ConsistencyAt>, kConsistencyDistancesM.size()> at;
  std::optional<Pose2> T_map_world;
  std::size_t next = 0;
  for (const DoubtedPose& pose : poses) {
    const StampedPose* truth = T_world_body.nearest(pose.stamp);
    if (truth == nullptr) continue;
    if (!T_map_world) T_map_world = pose.T_map_body * truth->pose.inverse();
    while (next < at.size() && pose.path_m >= kConsistencyDistancesM[next])
      at[next++] = compare(pose, *T_map_world * truth->pose);
  }
  return at;
}

AlarmCounts count_alarms(std::span<const DoubtedPose> poses, std::span<const StampedError> errors,
                         const AlarmTuning& tuning) {
  AlarmCounts counts;
  if (poses.empty()) return counts;
  counts.seconds = to_seconds(poses.back().stamp - poses.front().stamp);
  const std::vector<Alarm> alarms = alarms_of(poses);
  counts.alarms = alarms.size();
  for (const Alarm& alarm : alarms) {
    counts.seconds_doubted += to_seconds(alarm.end - alarm.begin);
    const std::optional<bool> judged = is_false(alarm, errors, tuning);
    if (!judged) ++counts.unjudged_alarms;
    if (judged.value_or(false)) ++counts.false_alarms;
  }
  for (const Alarm& off : times_off(errors, tuning)) {
    ++counts.times_off;
    const auto noticed = std::ranges::find_if(
        alarms, [&](const Alarm& alarm) { return alarm.end >= off.begin && alarm.begin <= off.end; });
    if (noticed != alarms.end())
      counts.noticed_s.push_back(std::max(0.0, to_seconds(noticed->begin - off.begin)));
  }
  return counts;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/evaluation/stamped_path.hpp"

#include <algorithm>
#include <utility>

#include "core/base/check.hpp"

namespace swiftlet {

StampedPath::StampedPath(std::vector<StampedPose> poses) : poses_(std::move(poses)) {
  std::stable_sort(poses_.begin(), poses_.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
}

std::vector<StampedPose>::const_iterator StampedPath::not_before(HostTime stamp) const {
  return std::lower_bound(poses_.begin(), poses_.end(), stamp,
                          [](const StampedPose& at, HostTime sought) { return at.stamp < sought; });
}

const StampedPose* StampedPath::nearest(HostTime stamp) const {
  return nearest_within(kStampTolerance, stamp);
}

const StampedPose* StampedPath::nearest_within(Duration tolerance, HostTime stamp) const {
  if (poses_.empty()) return nullptr;
  auto found = not_before(stamp);
  if (found == poses_.end() ||
      (found != poses_.begin() && stamp - (found - 1)->stamp <= found->stamp - stamp))
    found = not_before((found - 1)->stamp);
  return std::chrono::abs(found->stamp - stamp) <= tolerance ? &*found : nullptr;
}

std::optional<Point2> StampedPath::position_at(HostTime stamp) const {
  if (const StampedPose* same = nearest(stamp)) return same->pose.position();
  const auto after = not_before(stamp);
  const bool lies_between = after != poses_.begin() && after != poses_.end();
  if (lies_between && after->stamp - (after - 1)->stamp <= kLongestInterpolation)
    return interpolated(stamp).position();
  const StampedPose* near = nearest_within(kLooseTolerance, stamp);
  return near != nullptr ? std::optional(near->pose.position()) : std::nullopt;
}

Pose2 StampedPath::interpolated(HostTime stamp) const {
  SWIFTLET_CHECK(!poses_.empty(), "an empty path has no pose to interpolate");
  const auto after = not_before(stamp);
  if (after == poses_.end()) return poses_.back().pose;
  if (after == poses_.begin() || after->stamp == stamp) return after->pose;
  const StampedPose& before = *(after - 1);
  const double share = to_seconds(stamp - before.stamp) / to_seconds(after->stamp - before.stamp);
  const Pose2& from = before.pose;
  const Pose2& to = after->pose;
  return {from.x_m() + share * (to.x_m() - from.x_m()), from.y_m() + share * (to.y_m() - from.y_m()),
          from.yaw_rad() + share * wrap_angle(to.yaw_rad() - from.yaw_rad())};
}

StampMatching match_stamps(std::vector<HostTime> stamps, const StampedPath& path) {
  std::sort(stamps.begin(), stamps.end());
  stamps.erase(std::unique(stamps.begin(), stamps.end()), stamps.end());
  StampMatching matching;
  for (const HostTime stamp : stamps) {
    const StampedPose* match = path.nearest(stamp);
    if (match == nullptr) {
      matching.unmatched.push_back(stamp);
    } else if (std::chrono::abs(match->stamp - stamp) <= kExactStamp) {
      ++matching.exact;
    } else {
      ++matching.near;
    }
  }
  return matching;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/store/frontend_estimates.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"

namespace swiftlet {

void FrontendEstimates::take(const Keyframe& made) {
  const std::size_t count = made.T_local_keyframe.size();
  SWIFTLET_CHECK(count >= 1 && count <= T_local_keyframe_.size() + 1,
                 "the window ends with the new keyframe");
  T_local_keyframe_.push_back({});
  KeyframeId id = made.id - static_cast<std::uint32_t>(count - 1);
  for (const Pose2& T_local : made.T_local_keyframe) {
    T_local_keyframe_[id] = T_local;
    ++id;
  }
  take_walls(made);
  if (made.starts_segment && !made.odometry_ran_on) motion_known_since_ = made.id;
}

void FrontendEstimates::take_walls(const Keyframe& made) {
  for (const LandmarkUpdate& update : made.landmarks) {
    const Wall wall{update.id, made.id, update.start_keyframe, update.end_keyframe};
    const auto at = std::lower_bound(walls_.begin(), walls_.end(), update.id,
                                     [](const Wall& w, LandmarkId id) { return w.id < id; });
    if (at != walls_.end() && at->id == update.id) {
      *at = wall;
    } else {
      walls_.insert(at, wall);
    }
  }
}

void FrontendEstimates::erase(const IdRanges<KeyframeId>& pruned) {
  T_local_keyframe_.erase(pruned);
  std::erase_if(walls_, [&](const Wall& wall) { return pruned.contains(wall.anchor); });
}

std::optional<WallAxis> FrontendEstimates::wall_axis_around_newest(const KeyframeChain& chain, double reach_m,
                                                                   const WallAxisTuning& tuning) const {
  const KeyframeId newest = T_local_keyframe_.last_id();
  const double here_m = chain.path_m(newest);
  std::vector<WallDirection> around;
  for (const Wall& wall : walls_) {
    if (wall.anchor < motion_known_since_ || here_m - chain.path_m(wall.anchor) > reach_m) continue;
    const double dx_m = wall.end_keyframe.x_m - wall.start_keyframe.x_m;
    const double dy_m = wall.end_keyframe.y_m - wall.start_keyframe.y_m;
    const double turned_rad = T_local_keyframe_[wall.anchor].yaw_rad() - T_local_keyframe_[newest].yaw_rad();
    around.push_back({std::atan2(dy_m, dx_m) + turned_rad, std::hypot(dx_m, dy_m)});
  }
  return wall_axis(around, tuning);
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/backend/backend.hpp"
#include "core/evaluation/known_place_error.hpp"
#include "core/evaluation/stamped_path.hpp"
#include "tools/evaluation/confidence_history.hpp"

namespace swiftlet {

/// Keeps what a run publishes while it goes on: the live poses with their confidence, and the keyframes'
/// poses in the map as they change. Views the backend, which must outlive it. Allocates: 16 bytes a keyframe
/// and time it moves.
class LiveObserver {
 public:
  explicit LiveObserver(Backend& backend) : backend_(&backend), confidence_(backend) {}

  /// After each sample, until the final pass.
  void look();
  /// Of the moments whose stamps the true path has.
  [[nodiscard]] KnownPlaceError error(const StampedPath& T_world_body) const;
  [[nodiscard]] std::span<const DoubtedPose> doubted_poses() const { return confidence_.poses(); }

 private:
  struct Moment {
    HostTime stamp{};
    double path_m = 0.0;
    Pose2 T_map_body;
    Pose2 T_local_body;
    StoreyId storey{};
  };
  /// Published after the moment of this number.
  struct Published {
    std::uint32_t moment = 0;
    float x_m = 0.0F;
    float y_m = 0.0F;
    float yaw_rad = 0.0F;
  };
  struct History {
    std::uint32_t moment = 0;  ///< that made the keyframe
    std::vector<Published> poses;
    std::optional<std::uint32_t> erased;
  };
  [[nodiscard]] static Pose2 pose_of(const Published& published);
  void follow(KeyframeId keyframe);
  void note_erased();
  [[nodiscard]] std::vector<LiveMoment> moments(const StampedPath& T_world_body) const;
  [[nodiscard]] std::vector<PublishedKeyframe> keyframes(const StampedPath& T_world_body) const;

  const Backend* backend_;
  ConfidenceHistory confidence_;
  ScanId seen_{};
  std::vector<Moment> moments_;
  std::vector<History> histories_;  // by keyframe
  std::size_t held_ = 0;            // keyframes that the backend had when it was looked at
};

/// The newest pose of a finished run against the rest of its map: what all that was measured up to then can
/// give at that moment. 0 where the true path lacks it.
[[nodiscard]] KnownPlaceError newest_pose_error(const Backend& finished, const StampedPath& T_world_body);

}  // namespace swiftlet

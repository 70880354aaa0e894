// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/stamped_pose.hpp"

namespace swiftlet {

/// Files round stamps: closer stamps are the same instant.
inline constexpr Duration kExactStamp = std::chrono::microseconds(10);
/// Stamps farther apart are different instants.
inline constexpr Duration kStampTolerance = std::chrono::milliseconds(2);
/// Poses closer together may be interpolated: a vehicle that accelerates by 1 m/s^2 is off by 8 mm at most.
inline constexpr Duration kLongestInterpolation = std::chrono::milliseconds(250);
/// Where nothing can be interpolated, a pose that is no farther off may stand for another.
inline constexpr Duration kLooseTolerance = std::chrono::milliseconds(20);

/// An estimated or measured path: poses in order of their stamps. Immutable.
class StampedPath {
 public:
  /// Sorts by stamp; poses with equal stamps keep their order, and the first of them is the one found.
  explicit StampedPath(std::vector<StampedPose> poses);

  [[nodiscard]] std::span<const StampedPose> poses() const { return poses_; }
  /// The pose stamped nearest, the earlier of two as near; nullptr when none is within kStampTolerance.
  /// Lives as long as the path.
  [[nodiscard]] const StampedPose* nearest(HostTime stamp) const;
  /// The position at a stamp: that of nearest(); else interpolated between two poses that are at most
  /// kLongestInterpolation apart; else that of the pose nearest within kLooseTolerance; else none.
  [[nodiscard]] std::optional<Point2> position_at(HostTime stamp) const;
  /// Between two poses in proportion to time, yaw the short way round; the first or last pose beyond the
  /// ends. Precondition: not empty.
  [[nodiscard]] Pose2 interpolated(HostTime stamp) const;

 private:
  [[nodiscard]] const StampedPose* nearest_within(Duration tolerance, HostTime stamp) const;
  [[nodiscard]] std::vector<StampedPose>::const_iterator not_before(HostTime stamp) const;

  std::vector<StampedPose> poses_;
};

/// Counts of stamps by their match in a path; each stamp counts once.
struct StampMatching {
  std::size_t exact = 0;            ///< within kExactStamp
  std::size_t near = 0;             ///< farther off, within kStampTolerance
  std::vector<HostTime> unmatched;  ///< ascending
  std::size_t between = 0;          ///< where positions are compared: only by StampedPath::position_at()
};
[[nodiscard]] StampMatching match_stamps(std::vector<HostTime> stamps, const StampedPath& path);

}  // namespace swiftlet

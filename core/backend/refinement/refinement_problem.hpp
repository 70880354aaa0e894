// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/backend/refinement/point_to_line_factor.hpp"
#include "core/backend/refinement/wall_map.hpp"
#include "core/base/ids.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

struct PlacedReturn {
  PoseIndex pose{};  ///< of its scan, in the problem's list of poses
  std::uint32_t traversal = 0;
  StoreyId storey{};
  bool held_out = false;  ///< adds no factor and no point of a wall: it judges
  Point2 p_body;
};

/// Whether a return judges refined poses: of each beam one scan in ten, neighbouring beams one after another.
/// The same in every problem.
[[nodiscard]] inline bool is_held_out(ScanId scan, std::uint8_t beam, const RefinementTuning& tuning = {}) {
  return (index_of(scan) + beam) % tuning.hold_out_every == 0;
}

/// Of each beam one scan in so many leaves no more than about `most` of `count` returns: those with (scan +
/// beam) % n == 0. It has no divisor in common with the pattern of held-out returns, or either all of them
/// might be left or none.
[[nodiscard]] inline std::size_t thinned_by(std::size_t count, std::size_t most,
                                            const RefinementTuning& tuning) {
  std::size_t every = 1 + (std::max<std::size_t>(count, 1) - 1) / most;
  while (std::gcd(every, tuning.hold_out_every) != 1) ++every;
  return every;
}

/// What the held-out returns decide about refined poses.
struct HeldOutVerdict {
  double held_out_before_m = 0.0;  ///< capped mean distance of held-out returns from other traversals' walls
  double held_out_after_m = 0.0;
  bool accepted = false;  ///< false: the distance would have grown; poses untouched

  void judge(double before_m, double after_m) {
    held_out_before_m = before_m;
    held_out_after_m = after_m;
    accepted = after_m <= before_m;
  }
};

/// A wall map for each storey.
class WallsByStorey {
 public:
  explicit WallsByStorey(std::vector<WallMap> maps) : maps_(std::move(maps)) {}
  /// As WallMap has it. Precondition: there are walls of that storey, or a return was added there.
  [[nodiscard]] std::optional<LocalWall> wall_near(StoreyId storey, const TraversalPoint& place) const {
    return maps_[index_of(storey)].wall_near(place);
  }
  /// Points of all of them.
  [[nodiscard]] std::size_t size() const {
    std::size_t points = 0;
    for (const WallMap& map : maps_) points += map.size();
    return points;
  }

 private:
  std::vector<WallMap> maps_;
};

/// The returns of scans whose poses are refined together. Each is associated with the wall that the other
/// traversals draw around it. Poses are a list that the caller keeps. Allocates. One thread at a time.
class RefinementProblem {
 public:
  explicit RefinementProblem(const RefinementTuning& tuning) : tuning_(tuning) {}

  void clear() {
    returns_.clear();
    highest_ = {};
  }
  void add(const PlacedReturn& placed) {
    returns_.push_back(placed);
    highest_ = std::max(highest_, placed.storey);
  }
  [[nodiscard]] std::size_t size() const { return returns_.size(); }
  [[nodiscard]] std::span<const PlacedReturn> returns() const { return returns_; }

  /// The walls of all returns but the held-out ones at these poses. `others_thinned`: points of other
  /// traversals that add to them, all on one storey. Returns must have been added by traversal.
  [[nodiscard]] WallsByStorey walls_at(const std::vector<Pose2>& T_map_body, double radius_m,
                                       std::span<const TraversalPoint> others_thinned = {},
                                       StoreyId storey_of_others = {}) const;
  /// Adds to a system with `add(pose, H, rhs)` a point-to-line factor for each return that has a wall.
  template <typename System>
  void add_factors(const WallsByStorey& walls, const std::vector<Pose2>& T_map_body, System& system) const {
    for (const PlacedReturn& r : returns_) {
      if (r.held_out) continue;
      const Pose2& T = T_map_body[index_of(r.pose)];
      const std::optional<LocalWall> wall = walls.wall_near(r.storey, {T * r.p_body, r.traversal});
      if (!wall) continue;
      const PointToLineFactor factor = point_to_line_factor(*wall, T, r.p_body, tuning_);
      system.add(r.pose, factor.H, factor.rhs);
    }
  }
  /// Calls `take(traversal, distance_m)` for each held-out return, with its judged_distance_m() from the
  /// walls.
  template <typename Take>
  void for_held_out(const WallsByStorey& walls, const std::vector<Pose2>& T_map_body, Take&& take) const {
    for (const PlacedReturn& r : returns_) {
      if (!r.held_out) continue;
      const TraversalPoint at{T_map_body[index_of(r.pose)] * r.p_body, r.traversal};
      take(r.traversal, judged_distance_m(walls.wall_near(r.storey, at), at.p_map, tuning_));
    }
  }
  /// Mean distance of the held-out returns from the walls, as judged_distance_m() has it; 0 without any.
  [[nodiscard]] double held_out_error_m(const WallsByStorey& walls,
                                        const std::vector<Pose2>& T_map_body) const;

 private:
  RefinementTuning tuning_;
  std::vector<PlacedReturn> returns_;
  StoreyId highest_{};
};

}  // namespace swiftlet

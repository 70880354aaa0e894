// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/backend/config/backend_tuning.hpp"
#include "core/backend/refinement/local_moments.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// A line through the returns of other traversals around a place.
struct LocalWall {
  Point2 center_map;
  Point2 normal_map;  ///< unit length
};

/// The line through points with these moments relative to `place_map`; nothing where they are too few or not
/// clearly a line.
[[nodiscard]] std::optional<LocalWall> wall_through(const Moments2& moments, const Point2& place_map,
                                                    const WallFitTuning& tuning);

/// Appends one point per traversal and cell, the mean of those in it. `points` ordered by traversal.
void append_thinned(std::span<const TraversalPoint> points, double cell_m,
                    std::vector<TraversalPoint>& thinned);

/// The returns of all traversals, one point per traversal and cell, in which the walls around a place as the
/// *other* traversals measured them are found. Built once, then read by any thread. Allocates in the
/// constructor.
class WallMap {
 public:
  /// `points` ordered by traversal. `radius_m`: of the search around a place.
  WallMap(std::span<const TraversalPoint> points, double radius_m, const RefinementTuning& tuning = {})
      : WallMap({}, points, radius_m, tuning) {}
  /// The same with points of other traversals that are thinned already.
  WallMap(std::span<const TraversalPoint> thinned, std::span<const TraversalPoint> points, double radius_m,
          const RefinementTuning& tuning = {});

  /// The line through the points of other traversals within the radius, weighted by closeness; nothing where
  /// they are too few or not clearly a line.
  [[nodiscard]] std::optional<LocalWall> wall_near(const TraversalPoint& place) const;
  [[nodiscard]] std::size_t size() const { return points_.size(); }

 private:
  [[nodiscard]] std::vector<TraversalPoint> sorted_into_cells(const std::vector<TraversalPoint>& points);

  RefinementTuning tuning_;
  double radius_m_;
  Point2 origin_m_;
  int width_ = 0;
  int height_ = 0;
  PointColumns points_;                     // by cell
  std::vector<std::uint32_t> cell_starts_;  // width * height + 1
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/backend/refinement/local_moments.hpp"
#include "core/geometry/pose2.hpp"

namespace swiftlet {

/// The wall that other traversals draw around a point: a line through their returns nearby.
struct LocalWall {
  Point2 center_map;
  Point2 normal_map;  ///< unit length
};

/// Appends one point for each traversal and cell of 8 cm, in the middle of those there. `points` ordered by
/// traversal.
void append_thinned(std::span<const TraversalPoint> points, std::vector<TraversalPoint>& thinned);

/// The returns of all traversals, one point a traversal and cell, for asking what the *other* traversals draw
/// around a place. Built once, then read by any thread. Allocates in the constructor.
class WallMap {
 public:
  /// `points` ordered by traversal. `radius_m`: how far around a place its wall is looked for.
  WallMap(std::span<const TraversalPoint> points, double radius_m) : WallMap({}, points, radius_m) {}
  /// The same with points of other traversals that are thinned already.
  WallMap(std::span<const TraversalPoint> thinned, std::span<const TraversalPoint> points, double radius_m);

  /// The line through the points of other traversals within the radius, near ones counting more; nothing
  /// where they are too few or not clearly a line.
  [[nodiscard]] std::optional<LocalWall> wall_near(const TraversalPoint& place) const;
  [[nodiscard]] std::size_t size() const { return points_.size(); }

 private:
  [[nodiscard]] std::vector<TraversalPoint> sorted_into_cells(const std::vector<TraversalPoint>& points);

  double radius_m_;
  Point2 origin_m_;
  int width_ = 0;
  int height_ = 0;
  PointColumns points_;                     // by cell
  std::vector<std::uint32_t> cell_starts_;  // width * height + 1
};

}  // namespace swiftlet

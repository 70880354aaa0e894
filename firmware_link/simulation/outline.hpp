// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "firmware_link/simulation/world.hpp"

namespace swiftlet {

/// The corners of a convex area, counter-clockwise.
using Outline = std::vector<Point2>;

/// From (x0, y0) to (x1, y1) in the local frame, x0 < x1 and y0 < y1.
[[nodiscard]] Outline rectangle(const Pose2& T_world_local, double x0, double y0, double x1, double y1);
[[nodiscard]] Outline regular_polygon(const Point2& centre, double radius_m, int corners,
                                      double phase_rad = 0.0);
[[nodiscard]] Outline transformed(const Pose2& T_a_b, const Outline& outline_b);

[[nodiscard]] double distance_m(const WallSegment& wall, const Point2& point);
/// 0 where they cross.
[[nodiscard]] double distance_m(const WallSegment& a, const WallSegment& b);

[[nodiscard]] bool contains(const Outline& outline, const Point2& point);
/// Whether a straight line of at least that width separates them.
[[nodiscard]] bool are_apart(const Outline& a, const Outline& b, double gap_m);

/// The part of a wall from the share `from` of its length to the share `to`.
struct WallShare {
  double from = 0.0;
  double to = 1.0;
};
/// What lies inside by more than a millimetre; nullopt: nothing.
[[nodiscard]] std::optional<WallShare> share_inside(const WallSegment& wall, const Outline& outline);

}  // namespace swiftlet

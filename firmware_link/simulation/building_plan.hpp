// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <vector>

#include "firmware_link/simulation/outline.hpp"
#include "firmware_link/simulation/random.hpp"

namespace swiftlet {

/// Rooms along a corridor. Lengths in metres, evenly between the two values.
struct RoomStyle {
  double width_min_m = 2.5;  ///< along the corridor
  double width_max_m = 5.0;
  double depth_min_m = 2.5;
  double depth_max_m = 4.5;
  double built_share = 0.85;  ///< of the places where a room has room
  double open_share = 0.75;   ///< of the doors
};

/// A floor plan under construction: convex areas to be in, which merge where they overlap, and obstacles in
/// them. Walls surround the union of the areas.
class BuildingPlan {
 public:
  void add_area(Outline area) { areas_.push_back(std::move(area)); }
  /// Refused (false) unless it keeps that gap to all areas so far.
  bool add_area_if_free(const Outline& area, double gap_m);
  /// Along a line of points; a closed one returns to the first. Its outer corners are mitred.
  void add_corridor(const std::vector<Point2>& line, double width_m, bool is_closed = false);
  /// Rooms with doors on both sides of a straight corridor wherever they are free; a shut door is a niche,
  /// its room is left out.
  void add_rooms(const Point2& from, const Point2& to, double corridor_width_m, const RoomStyle& style,
                 NoiseSource& noise);
  /// The passage through the wall between two areas, from `from` to `to` along its axis.
  void add_door(const Point2& from, const Point2& to, double width_m);
  void add_obstacle(Outline obstacle) { obstacles_.push_back(std::move(obstacle)); }
  /// Not to be flown through, but no wall: under a table.
  void keep_out(Outline area) { kept_out_.push_back(std::move(area)); }
  /// What was added so far, again, at another pose.
  void repeat(const std::vector<Pose2>& T_first_others);
  /// No walls around the areas.
  void open_to_the_sky() { is_open_ = true; }

  [[nodiscard]] const std::vector<Outline>& areas() const { return areas_; }
  [[nodiscard]] const std::vector<Outline>& obstacles() const { return obstacles_; }
  [[nodiscard]] const std::vector<Outline>& kept_out() const { return kept_out_; }
  /// The walls around the areas, each with its area to the left.
  [[nodiscard]] std::vector<WallSegment> boundary() const;
  /// Those, and the sides of the obstacles.
  [[nodiscard]] std::vector<WallSegment> walls() const;
  void transform(const Pose2& T_new_old);

 private:
  [[nodiscard]] std::vector<WallShare> shares_outside(const WallSegment& wall, std::size_t of_area) const;
  void add_room(const Pose2& T_world_side, double x_m, double width_m, const RoomStyle& style,
                NoiseSource& noise);

  std::vector<Outline> areas_;
  std::vector<Outline> obstacles_;
  std::vector<Outline> kept_out_;
  bool is_open_ = false;
};

/// Between low and high, both included.
[[nodiscard]] int whole_between(NoiseSource& noise, int low, int high);

}  // namespace swiftlet

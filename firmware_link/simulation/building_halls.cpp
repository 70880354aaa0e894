// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <algorithm>
#include <cmath>
#include <vector>

#include "firmware_link/simulation/building_furniture.hpp"
#include "firmware_link/simulation/building_kinds.hpp"

namespace swiftlet {
namespace {

/// A rectangle around the origin, or a polygon with uneven sides.
Outline hall(const BuildingWish& wish, NoiseSource& noise) {
  const double half_x_m = std::max(3.0, side_m(wish, noise) / 2.0);
  const double half_y_m = std::max(2.5, half_x_m * noise.uniform(0.4, 1.0));
  if (wish.directions == WallDirections::kOne) return rectangle({}, -half_x_m, -half_y_m, half_x_m, half_y_m);
  const int sides = whole_between(noise, 5, 9);
  Outline corners = regular_polygon({}, 1.0, sides, noise.uniform(0.0, kPi));
  const double squash = noise.uniform(-0.3, 0.3);
  for (Point2& corner : corners)
    corner = {half_x_m * 1.15 * corner.x_m + squash * corner.y_m, half_y_m * 1.15 * corner.y_m};
  return corners;
}

/// Corners of a lattice in the hall, at least that far from its walls.
std::vector<Point2> lattice(const Outline& hall, double pitch_m, double from_walls_m) {
  std::vector<Point2> points;
  constexpr int kReach = 12;
  for (int i = -kReach; i <= kReach; ++i) {
    for (int j = -kReach; j <= kReach; ++j) {
      const Point2 at{(i + 0.5) * pitch_m, (j + 0.5) * pitch_m};
      const Outline around = regular_polygon(at, from_walls_m, 8);
      if (std::ranges::all_of(around, [&](const Point2& p) { return contains(hall, p); }))
        points.push_back(at);
    }
  }
  return points;
}

}  // namespace

/// Pillars stand on a lattice, of which some are missing.
BuildingPlan draw_pillar_hall(const BuildingWish& wish, NoiseSource& noise) {
  BuildingPlan plan;
  const Outline walls = hall(wish, noise);
  plan.add_area(walls);
  const double radius_m = noise.uniform(0.15, 0.5);
  const bool is_square = wish.directions == WallDirections::kOne || noise.chance(0.5);
  const double turn = wish.directions == WallDirections::kOne ? kPi / 4.0 : noise.uniform(0.0, kPi);
  const double missing = noise.uniform(0.0, 0.4);
  for (const Point2& at : lattice(walls, noise.uniform(2.2, 4.5) + radius_m, radius_m + 1.0))
    if (!noise.chance(missing)) plan.add_obstacle(regular_polygon(at, radius_m, is_square ? 4 : 10, turn));
  furnish(plan, {.at_walls = whole_between(noise, 0, 14), .people = whole_between(noise, 0, 4)}, noise);
  return plan;
}

/// Rooms in a row, each behind an opening in the wall of the one before, full of furniture.
BuildingPlan draw_cluttered_rooms(const BuildingWish& wish, NoiseSource& noise) {
  BuildingPlan plan;
  const bool is_bent = wish.directions == WallDirections::kSeveral;
  const int rooms = std::clamp(static_cast<int>(wish.way_m / 25.0), 1, 6);
  Pose2 T_world_room;
  for (int i = 0; i < rooms; ++i) {
    const double length_m = noise.uniform(3.5, 8.0);
    const double half_m = noise.uniform(1.8, 4.0);
    plan.add_area(rectangle(T_world_room, 0.0, -half_m, length_m, half_m));
    const double y_m = noise.uniform(-0.6, 0.6) * (half_m - 0.8);
    const double wall_m = is_bent ? noise.uniform(1.0, 1.8) : noise.uniform(0.15, 0.4);
    const Pose2 T_world_door = T_world_room * Pose2(length_m, y_m, 0.0);
    if (i + 1 < rooms)
      plan.add_door(T_world_door * Point2{-0.3, 0.0}, T_world_door * Point2{wall_m + 0.5, 0.0},
                    noise.uniform(0.9, 1.8));
    const double bend = is_bent ? radians(noise.uniform(-25.0, 25.0)) : 0.0;
    T_world_room = T_world_door * Pose2(wall_m, 0.0, bend);
  }
  furnish(plan,
          {.at_walls = whole_between(noise, 3 * rooms, 12 * rooms),
           .tables = whole_between(noise, rooms, 3 * rooms),
           .chairs = whole_between(noise, rooms, 5 * rooms),
           .people = whole_between(noise, 0, 2 * rooms),
           .is_askew = is_bent || noise.chance(0.3)},
          noise);
  return plan;
}

/// Racks in rows with aisles between them and ways across; in a second hall at another angle, too.
BuildingPlan draw_warehouse(const BuildingWish& wish, NoiseSource& noise) {
  BuildingPlan plan;
  const double length_m = std::max(8.0, side_m(wish, noise));
  const double aisle_m = noise.uniform(1.6, 2.8);
  const double rack_m = noise.uniform(0.8, 1.4);
  const int racks =
      std::clamp(static_cast<int>(length_m * noise.uniform(0.5, 1.0) / (aisle_m + rack_m)), 2, 7);
  const double height_m = racks * (aisle_m + rack_m) + aisle_m;
  const int blocks = length_m > 16.0 ? whole_between(noise, 1, 2) : 1;
  const double block_m = (length_m - (blocks + 1) * (aisle_m + 0.4)) / blocks;
  plan.add_area(rectangle({}, 0.0, 0.0, length_m, height_m));
  for (int rack = 0; rack < racks; ++rack) {
    const double y_m = aisle_m + rack * (aisle_m + rack_m);
    for (int block = 0; block < blocks; ++block) {
      const double x_m = aisle_m + 0.4 + block * (block_m + aisle_m + 0.4);
      const double cut_m = noise.uniform(0.0, 0.15) * block_m;
      plan.add_obstacle(rectangle({}, x_m + cut_m, y_m, x_m + block_m, y_m + rack_m));
    }
  }
  if (wish.directions == WallDirections::kSeveral) {
    // The hall again, from the middle of this one's right wall on, at an angle.
    const double turn = noise.either_sign(radians(noise.uniform(15.0, 40.0)));
    const double between_m = 1.0 + height_m / 2.0 * std::sin(std::abs(turn));
    plan.add_door({length_m - 0.4, height_m / 2.0}, {length_m + between_m + 0.6, height_m / 2.0},
                  noise.uniform(1.5, 2.5));
    plan.repeat({Pose2(length_m + between_m, height_m / 2.0, turn) * Pose2(0.0, -height_m / 2.0, 0.0)});
  }
  furnish(plan, {.at_walls = whole_between(noise, 0, 10), .people = whole_between(noise, 0, 3)}, noise);
  return plan;
}

/// The same wing again and again around a hall: two or four at right angles, or three or five.
BuildingPlan draw_symmetrical(const BuildingWish& wish, NoiseSource& noise) {
  const bool is_square = wish.directions == WallDirections::kOne;
  const int wings = is_square ? 2 * whole_between(noise, 1, 2) : 3 + 2 * whole_between(noise, 0, 1);
  const double width_m = noise.uniform(1.6, 2.4);
  const double hall_m = noise.uniform(1.0, 1.6) * width_m;
  const double length_m = hall_m + std::max(5.0, side_m(wish, noise) * 0.7);
  // Rooms begin where the wings are far enough apart.
  const double depth_m = noise.uniform(2.4, 3.6);
  const double apart_m = (depth_m + width_m / 2.0 + 0.4) / std::tan(kPi / wings);
  BuildingPlan plan;
  plan.add_corridor({{0.0, 0.0}, {length_m, 0.0}}, width_m);
  const RoomStyle style{.depth_min_m = depth_m - 0.2, .depth_max_m = depth_m, .built_share = 0.9};
  plan.add_rooms({std::max(hall_m, apart_m), 0.0}, {length_m, 0.0}, width_m, style, noise);
  std::vector<Pose2> others;
  for (int i = 1; i < wings; ++i) others.emplace_back(0.0, 0.0, 2.0 * kPi * i / wings);
  plan.repeat(others);
  plan.add_area(regular_polygon({}, hall_m, is_square ? 4 : wings, kPi / (is_square ? 4 : wings)));
  return plan;
}

}  // namespace swiftlet

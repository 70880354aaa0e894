// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <algorithm>
#include <cmath>
#include <vector>

#include "firmware_link/simulation/building_furniture.hpp"
#include "firmware_link/simulation/building_kinds.hpp"

namespace swiftlet {
namespace {

double corridor_width_m(NoiseSource& noise) { return noise.uniform(1.5, 2.6); }

RoomStyle room_style(NoiseSource& noise) {
  RoomStyle style;
  style.width_min_m = noise.uniform(2.2, 3.5);
  style.width_max_m = style.width_min_m + noise.uniform(0.2, 4.0);
  style.depth_min_m = noise.uniform(2.2, 3.5);
  style.depth_max_m = style.depth_min_m + noise.uniform(0.0, 2.5);
  style.built_share = noise.uniform(0.5, 1.0);
  style.open_share = noise.uniform(0.35, 1.0);
  return style;
}

/// Cupboards and a table here and there, by the size of the building.
void furnish_offices(BuildingPlan& plan, NoiseSource& noise) {
  const int areas = static_cast<int>(plan.areas().size());
  furnish(plan,
          {.at_walls = whole_between(noise, 0, 2 * areas),
           .tables = whole_between(noise, 0, areas / 3),
           .chairs = whole_between(noise, 0, areas / 3),
           .people = whole_between(noise, 0, areas / 6),
           .is_askew = noise.chance(0.3)},
          noise);
}

Point2 moved(const Point2& from, double bearing, double length_m) {
  return {from.x_m + length_m * std::cos(bearing), from.y_m + length_m * std::sin(bearing)};
}

/// Points on an arc to the left of `from` (to the right with a negative radius), at most 0.8 m apart.
std::vector<Point2> arc(const Pose2& from, double radius_m, double angle_rad) {
  const Point2 centre = from * Point2{0.0, radius_m};
  const int pieces = std::max(2, static_cast<int>(std::ceil(std::abs(radius_m) * angle_rad / 0.8)));
  std::vector<Point2> points;
  for (int i = 0; i <= pieces; ++i) {
    const double turned = std::copysign(angle_rad * i / pieces, radius_m);
    points.push_back(moved(centre, from.yaw_rad() + turned - kPi / 2.0, radius_m));
  }
  return points;
}

/// Rooms at places along a bent corridor.
void add_rooms_along_arc(BuildingPlan& plan, const std::vector<Point2>& line, double width_m,
                         const RoomStyle& style, NoiseSource& noise) {
  for (std::size_t i = 3; i + 3 < line.size(); i += 6) {
    const double bearing = bearing_rad(line[i - 1], line[i + 1]);
    plan.add_rooms(moved(line[i], bearing, -2.2), moved(line[i], bearing, 2.2), width_m, style, noise);
  }
}

/// Corners around the origin at uneven angles and distances, or of a rectangle.
std::vector<Point2> ring(WallDirections directions, double perimeter_m, NoiseSource& noise) {
  if (directions == WallDirections::kOne) {
    const double long_side_m = perimeter_m * noise.uniform(0.27, 0.38);
    const double short_side_m = perimeter_m / 2.0 - long_side_m;
    return {{0.0, 0.0}, {long_side_m, 0.0}, {long_side_m, short_side_m}, {0.0, short_side_m}};
  }
  const int corners = whole_between(noise, 3, 7);
  const double radius_m = perimeter_m / (2.0 * corners * std::sin(kPi / corners));
  std::vector<Point2> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * kPi * (i + noise.uniform(-0.17, 0.17)) / corners;
    points.push_back(moved({}, angle, radius_m * noise.uniform(0.75, 1.2)));
  }
  return points;
}

}  // namespace

/// Parallel corridors, joined by others at right angles, rooms in between.
BuildingPlan draw_offices(const BuildingWish& wish, NoiseSource& noise) {
  BuildingPlan plan;
  const double width_m = corridor_width_m(noise);
  const double length_m = std::max(9.0, side_m(wish, noise, 1.0, 1.5));
  const double pitch_m = noise.uniform(6.5, 10.0) + width_m;
  const int rows = std::clamp(static_cast<int>(side_m(wish, noise) / pitch_m) + 1, 1, 3);
  const int joins = rows == 1 ? whole_between(noise, 0, 1) : whole_between(noise, 2, length_m > 18.0 ? 3 : 2);
  for (int row = 0; row < rows; ++row)
    plan.add_corridor({{0.0, row * pitch_m}, {length_m, row * pitch_m}}, width_m);
  for (int join = 0; join < joins; ++join) {
    const double x_m = joins == 1 ? noise.uniform(0.2, 0.8) * length_m
                                  : (length_m - width_m) * join / (joins - 1) + width_m / 2.0;
    const double past_m = rows == 1 ? noise.uniform(3.0, 7.0) : 0.0;
    plan.add_corridor({{x_m, -past_m}, {x_m, (rows - 1) * pitch_m + past_m}}, width_m);
  }
  const RoomStyle style = room_style(noise);
  for (int row = 0; row < rows; ++row)
    plan.add_rooms({0.0, row * pitch_m}, {length_m, row * pitch_m}, width_m, style, noise);
  furnish_offices(plan, noise);
  return plan;
}

/// Straight wings that leave a hall at any angles, some of them with a bend.
BuildingPlan draw_wings(const BuildingWish& wish, NoiseSource& noise) {
  BuildingPlan plan;
  const int wings = whole_between(noise, 2, 4);
  const double hall_m = noise.uniform(1.8, 3.5);
  const int hall_corners = whole_between(noise, 5, 9);
  plan.add_area(regular_polygon({}, hall_m, hall_corners, noise.uniform(0.0, kPi)));
  const double width_m = corridor_width_m(noise);
  std::vector<std::vector<Point2>> lines;
  double angle = noise.uniform(0.0, 2.0 * kPi);
  for (int i = 0; i < wings; ++i) {
    const double length_m = hall_m + std::max(4.0, side_m(wish, noise, 0.4, 0.8));
    std::vector<Point2> line{{}, moved({}, angle, length_m)};
    const double bend = noise.either_sign(radians(noise.uniform(10.0, 60.0)));
    if (noise.chance(0.4))
      line.push_back(moved(line[1], angle + bend, std::max(4.0, length_m * noise.uniform(0.3, 0.7))));
    plan.add_corridor(line, width_m);
    lines.push_back(line);
    angle += 2.0 * kPi / wings + radians(noise.uniform(-28.0, 28.0));
  }
  const RoomStyle style = room_style(noise);
  for (const std::vector<Point2>& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i) plan.add_rooms(line[i - 1], line[i], width_m, style, noise);
  furnish_offices(plan, noise);
  return plan;
}

/// A ring, or arcs one after the other, and now and then a straight spoke.
BuildingPlan draw_curved_corridors(const BuildingWish& wish, NoiseSource& noise) {
  BuildingPlan plan;
  const double width_m = corridor_width_m(noise);
  const RoomStyle style = room_style(noise);
  const double radius_m = std::clamp(side_m(wish, noise, 0.4, 0.7), 4.0, 14.0);
  std::vector<Point2> line;
  if (noise.chance(0.5)) {
    line = arc(Pose2(0.0, -radius_m, 0.0), radius_m, 2.0 * kPi);
    line.pop_back();
    plan.add_corridor(line, width_m, true);
    if (noise.chance(0.5)) plan.add_corridor({line.front(), line[line.size() / 2]}, width_m);
  } else {
    const double first_radius_m = noise.either_sign(radius_m);
    const double next_radius_m = noise.either_sign(radius_m * noise.uniform(0.6, 1.3));
    line = arc(Pose2(), first_radius_m, noise.uniform(0.8, 2.8));
    const Pose2 end(line.back().x_m, line.back().y_m, bearing_rad(line[line.size() - 2], line.back()));
    const std::vector<Point2> other = arc(end, next_radius_m, noise.uniform(0.8, 2.4));
    line.insert(line.end(), other.begin() + 1, other.end());
    plan.add_corridor(line, width_m);
  }
  add_rooms_along_arc(plan, line, width_m, style, noise);
  furnish_offices(plan, noise);
  return plan;
}

/// Corridors that bend at uneven angles, open or as a ring with a cross corridor.
BuildingPlan draw_polygonal_corridors(const BuildingWish& wish, NoiseSource& noise) {
  BuildingPlan plan;
  const double width_m = corridor_width_m(noise);
  const bool is_ring = noise.chance(0.5);
  std::vector<Point2> line;
  if (is_ring) {
    line = ring(WallDirections::kSeveral, std::max(26.0, 2.8 * side_m(wish, noise)), noise);
    plan.add_corridor(line, width_m, true);
    if (line.size() > 4 && noise.chance(0.5)) plan.add_corridor({line[0], line[line.size() / 2]}, width_m);
    line.push_back(line.front());
  } else {
    line.push_back({});
    double bearing = noise.uniform(-kPi, kPi);
    double turn = noise.either_sign(1.0);
    for (int legs = whole_between(noise, 3, 6); legs > 0; --legs) {
      line.push_back(moved(line.back(), bearing, std::max(3.5, side_m(wish, noise, 0.25, 0.6))));
      bearing += turn * radians(noise.uniform(15.0, 65.0));
      if (noise.chance(0.5)) turn = -turn;
    }
    plan.add_corridor(line, width_m);
  }
  const RoomStyle style = room_style(noise);
  for (std::size_t i = 1; i < line.size(); ++i) plan.add_rooms(line[i - 1], line[i], width_m, style, noise);
  furnish_offices(plan, noise);
  return plan;
}

/// One corridor whose ends meet, with few rooms.
BuildingPlan draw_long_loop(const BuildingWish& wish, NoiseSource& noise) {
  BuildingPlan plan;
  const double width_m = corridor_width_m(noise);
  const double perimeter_m = std::clamp(wish.way_m * noise.uniform(0.2, 0.5), 28.0, 140.0);
  std::vector<Point2> line = ring(wish.directions, perimeter_m, noise);
  plan.add_corridor(line, width_m, true);
  RoomStyle style = room_style(noise);
  style.built_share = noise.uniform(0.0, 0.25);
  line.push_back(line.front());
  for (std::size_t i = 1; i < line.size(); ++i) plan.add_rooms(line[i - 1], line[i], width_m, style, noise);
  furnish(plan, {.at_walls = whole_between(noise, 0, static_cast<int>(perimeter_m / 3.0))}, noise);
  return plan;
}

}  // namespace swiftlet

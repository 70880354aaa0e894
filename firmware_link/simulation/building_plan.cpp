// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/building_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace swiftlet {
namespace {

constexpr double kOverlapM = 0.05;  // of areas that are to merge
constexpr std::array kWallThicknessM{0.15, 0.3, 0.6,
                                     1.0};  // the first that leaves room; thicker where walls bend
constexpr double kNicheM = 0.06;            // how deep a shut door lies in its wall
constexpr double kShortestWallM = 2e-3;

Point2 along(const Point2& from, double bearing, double length_m) {
  return {from.x_m + length_m * std::cos(bearing), from.y_m + length_m * std::sin(bearing)};
}

WallSegment side(const Outline& outline, std::size_t i) {
  return {outline[i], outline[(i + 1) % outline.size()]};
}

Point2 point_at(const WallSegment& wall, double share) {
  return {wall.start.x_m + share * (wall.end.x_m - wall.start.x_m),
          wall.start.y_m + share * (wall.end.y_m - wall.start.y_m)};
}

/// How far a corridor goes past a corner so that its outer walls meet.
double mitre_m(double turn_rad, double width_m) {
  return kOverlapM + width_m / 2.0 * std::tan(std::min(std::abs(turn_rad), radians(100.0)) / 2.0);
}

}  // namespace

int whole_between(NoiseSource& noise, int low, int high) {
  return low + static_cast<int>(noise.uniform(0.0, 1.0) * (high - low + 1));
}

bool BuildingPlan::add_area_if_free(const Outline& area, double gap_m) {
  if (!std::ranges::all_of(areas_, [&](const Outline& other) { return are_apart(area, other, gap_m); }))
    return false;
  add_area(area);
  return true;
}

void BuildingPlan::add_corridor(const std::vector<Point2>& line, double width_m, bool is_closed) {
  const std::size_t legs = is_closed ? line.size() : line.size() - 1;
  const auto point = [&](std::size_t i) { return line[i % line.size()]; };
  const auto turn_at = [&](std::size_t i) {
    if (!is_closed && (i == 0 || i == legs)) return 0.0;
    const std::size_t before = i == 0 ? line.size() - 1 : i - 1;
    return wrap_angle(bearing_rad(point(i), point(i + 1)) - bearing_rad(point(before), point(i)));
  };
  for (std::size_t i = 0; i < legs; ++i) {
    const double bearing = bearing_rad(point(i), point(i + 1));
    add_area(rectangle(Pose2(point(i).x_m, point(i).y_m, bearing), -mitre_m(turn_at(i), width_m),
                       -width_m / 2.0, distance_m(point(i), point(i + 1)) + mitre_m(turn_at(i + 1), width_m),
                       width_m / 2.0));
  }
}

void BuildingPlan::add_rooms(const Point2& from, const Point2& to, double corridor_width_m,
                             const RoomStyle& style, NoiseSource& noise) {
  const double length_m = distance_m(from, to);
  for (const bool is_left : {true, false}) {
    const Point2 begin = is_left ? from : to;
    const double bearing = bearing_rad(begin, is_left ? to : from);
    const Point2 edge = along(begin, bearing + kPi / 2.0, corridor_width_m / 2.0);
    const Pose2 T_world_side(edge.x_m, edge.y_m, bearing);
    double x_m = noise.uniform(0.0, 0.5);
    while (length_m - x_m > 2.2) {
      const double width_m =
          std::min(noise.uniform(style.width_min_m, style.width_max_m), length_m - x_m - 0.1);
      if (noise.chance(style.built_share)) add_room(T_world_side, x_m, width_m, style, noise);
      x_m += width_m + kWallThicknessM.front();
    }
  }
}

/// `T_world_side`: on the corridor's wall, the room to the left.
void BuildingPlan::add_room(const Pose2& T_world_side, double x_m, double width_m, const RoomStyle& style,
                            NoiseSource& noise) {
  const double depth_m = noise.uniform(style.depth_min_m, style.depth_max_m);
  const double door_x_m = x_m + noise.uniform(0.7, std::max(0.7, width_m - 0.7));
  const double door_width_m = noise.uniform(0.9, 1.2);
  const bool is_open = noise.chance(style.open_share);
  for (const double wall_m : kWallThicknessM) {
    if (!add_area_if_free(rectangle(T_world_side, x_m, wall_m, x_m + width_m, wall_m + depth_m), 0.09))
      continue;
    if (!is_open) areas_.pop_back();
    const double end_m = is_open ? wall_m + kOverlapM : kNicheM;
    add_door(T_world_side * Point2{door_x_m, is_open ? -0.3 : -kOverlapM},
             T_world_side * Point2{door_x_m, end_m}, door_width_m);
    return;
  }
}

void BuildingPlan::add_door(const Point2& from, const Point2& to, double width_m) {
  add_area(rectangle(Pose2(from.x_m, from.y_m, bearing_rad(from, to)), 0.0, -width_m / 2.0,
                     distance_m(from, to), width_m / 2.0));
}

void BuildingPlan::repeat(const std::vector<Pose2>& T_first_others) {
  const std::vector<Outline> areas = areas_;
  const std::vector<Outline> obstacles = obstacles_;
  const std::vector<Outline> kept_out = kept_out_;
  for (const Pose2& T_first_other : T_first_others) {
    for (const Outline& area : areas) add_area(transformed(T_first_other, area));
    for (const Outline& obstacle : obstacles) add_obstacle(transformed(T_first_other, obstacle));
    for (const Outline& area : kept_out) keep_out(transformed(T_first_other, area));
  }
}

std::vector<WallSegment> BuildingPlan::boundary() const {
  std::vector<WallSegment> walls;
  if (is_open_) return walls;
  for (std::size_t area = 0; area < areas_.size(); ++area) {
    for (std::size_t i = 0; i < areas_[area].size(); ++i) {
      const WallSegment whole = side(areas_[area], i);
      for (const auto& [from, to] : shares_outside(whole, area)) {
        const WallSegment wall{point_at(whole, from), point_at(whole, to)};
        if (distance_m(wall.start, wall.end) > kShortestWallM) walls.push_back(wall);
      }
    }
  }
  return walls;
}

/// The parts of a side of one area that lie in no other.
std::vector<WallShare> BuildingPlan::shares_outside(const WallSegment& wall, std::size_t of_area) const {
  std::vector<WallShare> inside;
  for (std::size_t i = 0; i < areas_.size(); ++i)
    if (i != of_area)
      if (const std::optional<WallShare> share = share_inside(wall, areas_[i])) inside.push_back(*share);
  std::ranges::sort(inside, {}, &WallShare::from);
  std::vector<WallShare> outside;
  double at = 0.0;
  for (const auto& [from, to] : inside) {
    if (from > at) outside.push_back({at, from});
    at = std::max(at, to);
  }
  if (at < 1.0) outside.push_back({at, 1.0});
  return outside;
}

std::vector<WallSegment> BuildingPlan::walls() const {
  std::vector<WallSegment> walls = boundary();
  for (const Outline& obstacle : obstacles_)
    for (std::size_t i = 0; i < obstacle.size(); ++i) walls.push_back(side(obstacle, i));
  return walls;
}

void BuildingPlan::transform(const Pose2& T_new_old) {
  for (Outline& area : areas_) area = transformed(T_new_old, area);
  for (Outline& obstacle : obstacles_) obstacle = transformed(T_new_old, obstacle);
  for (Outline& area : kept_out_) area = transformed(T_new_old, area);
}

}  // namespace swiftlet

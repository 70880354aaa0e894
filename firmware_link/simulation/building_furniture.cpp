// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/building_furniture.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace swiftlet {
namespace {

constexpr double kPassageM = 1.0;  // left free around a piece
constexpr int kAttempts = 4;       // for each piece
constexpr double kLegM = 0.05;
constexpr double kChairM = 0.42;
constexpr double kPersonM = 0.22;  // radius

class Furnisher {
 public:
  Furnisher(BuildingPlan& plan, NoiseSource& noise) : plan_(plan), noise_(noise), walls_(plan.walls()) {}

  void place_at_wall();
  void place_table(bool is_askew);
  void place_chair(bool is_askew);
  void place_person();

 private:
  /// A free place for a piece of that radius: its pose, turned by any angle or by right angles.
  std::optional<Pose2> find_place(double radius_m, bool is_askew);
  void add(const Outline& piece);

  BuildingPlan& plan_;
  NoiseSource& noise_;
  std::vector<WallSegment> walls_;
};

void Furnisher::add(const Outline& piece) {
  plan_.add_obstacle(piece);
  for (std::size_t i = 0; i < piece.size(); ++i) walls_.push_back({piece[i], piece[(i + 1) % piece.size()]});
}

std::optional<Pose2> Furnisher::find_place(double radius_m, bool is_askew) {
  const auto& areas = plan_.areas();
  const Outline& area =
      areas[static_cast<std::size_t>(whole_between(noise_, 0, static_cast<int>(areas.size()) - 1))];
  const auto [left, right] = std::ranges::minmax(area, {}, &Point2::x_m);
  const auto [low, high] = std::ranges::minmax(area, {}, &Point2::y_m);
  const Point2 at{noise_.uniform(left.x_m, right.x_m), noise_.uniform(low.y_m, high.y_m)};
  const double along_area = bearing_rad(area[0], area[1]);
  const double turn = is_askew ? noise_.uniform(-kPi, kPi) : kPi / 2.0 * whole_between(noise_, 0, 3);
  if (!contains(area, at)) return std::nullopt;
  for (const WallSegment& wall : walls_)
    if (distance_m(wall, at) < radius_m + kPassageM) return std::nullopt;
  return Pose2(at.x_m, at.y_m, along_area + turn);
}

/// Its back to a wall, away from corners and doors.
void Furnisher::place_at_wall() {
  const WallSegment host =
      walls_[static_cast<std::size_t>(whole_between(noise_, 0, static_cast<int>(walls_.size()) - 1))];
  const double length_m = distance_m(host.start, host.end);
  const double width_m = noise_.uniform(0.2, 1.6);
  const double depth_m = noise_.uniform(0.15, 0.55);
  const double at_m = noise_.uniform(0.0, 1.0) * (length_m - width_m);
  if (at_m < 0.0) return;
  const Pose2 T_world_wall(host.start.x_m, host.start.y_m, bearing_rad(host.start, host.end));
  const Point2 front = T_world_wall * Point2{at_m + width_m / 2.0, depth_m};
  const Pose2 T_wall_world = T_world_wall.inverse();
  for (const WallSegment& wall : walls_) {
    const bool is_in_front = std::max((T_wall_world * wall.start).y_m, (T_wall_world * wall.end).y_m) > 0.02;
    if (is_in_front && distance_m(wall, front) < width_m / 2.0 + kPassageM) return;
  }
  add(rectangle(T_world_wall, at_m, 0.0, at_m + width_m, depth_m));
}

void Furnisher::place_table(bool is_askew) {
  const double length_m = noise_.uniform(0.8, 2.0);
  const double width_m = noise_.uniform(0.6, 0.9);
  const int chairs = whole_between(noise_, 0, 4);
  const double radius_m = std::hypot(length_m, width_m) / 2.0 + (chairs > 0 ? 0.3 : 0.0);
  const std::optional<Pose2> T_world_table = find_place(radius_m, is_askew);
  if (!T_world_table) return;
  plan_.keep_out(rectangle(*T_world_table, -length_m / 2.0, -width_m / 2.0, length_m / 2.0, width_m / 2.0));
  for (const double x : {-length_m / 2.0, length_m / 2.0 - kLegM})
    for (const double y : {-width_m / 2.0, width_m / 2.0 - kLegM})
      add(rectangle(*T_world_table, x, y, x + kLegM, y + kLegM));
  for (int i = 0; i < chairs; ++i) {
    const double x = (i % 2 == 0 ? -0.25 : 0.25) * length_m - kChairM / 2.0;
    const double y = i < 2 ? width_m / 2.0 : -width_m / 2.0 - kChairM;
    add(rectangle(*T_world_table, x, y, x + kChairM, y + kChairM));
  }
}

void Furnisher::place_chair(bool is_askew) {
  constexpr double kHalfM = kChairM / 2.0;
  if (const std::optional<Pose2> T_world_chair = find_place(kChairM, is_askew))
    add(rectangle(*T_world_chair, -kHalfM, -kHalfM, kHalfM, kHalfM));
}

void Furnisher::place_person() {
  if (const std::optional<Pose2> T_world_person = find_place(kPersonM, true))
    add(regular_polygon(T_world_person->position(), kPersonM, 8, T_world_person->yaw_rad()));
}

}  // namespace

void furnish(BuildingPlan& plan, const FurnitureWish& wish, NoiseSource& noise) {
  Furnisher furnisher(plan, noise);
  for (int i = 0; i < kAttempts * wish.tables; ++i) furnisher.place_table(wish.is_askew);
  for (int i = 0; i < kAttempts * wish.people; ++i) furnisher.place_person();
  for (int i = 0; i < kAttempts * wish.chairs; ++i) furnisher.place_chair(wish.is_askew);
  for (int i = 0; i < kAttempts * wish.at_walls; ++i) furnisher.place_at_wall();
}

}  // namespace swiftlet

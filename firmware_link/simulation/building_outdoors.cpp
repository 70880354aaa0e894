// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <algorithm>
#include <cmath>

#include "firmware_link/simulation/building_kinds.hpp"

namespace swiftlet {
namespace {

/// A place in the middle part of a square of that side.
Pose2 somewhere(double side_m, NoiseSource& noise) {
  const double x_m = noise.uniform(-0.5, 0.5) * side_m;
  const double y_m = noise.uniform(-0.5, 0.5) * side_m;
  return {x_m, y_m, noise.uniform(-kPi, kPi)};
}

void add_block(BuildingPlan& plan, const Pose2& T_world_block, double length_m, double width_m) {
  plan.add_obstacle(rectangle(T_world_block, -length_m / 2.0, -width_m / 2.0, length_m / 2.0, width_m / 2.0));
}

}  // namespace

/// Open ground with a few houses, trees, cars and fences at any angles.
BuildingPlan draw_outdoors(const BuildingWish& wish, NoiseSource& noise) {
  BuildingPlan plan;
  plan.open_to_the_sky();
  const double ground_m = std::max(12.0, 1.3 * side_m(wish, noise));
  plan.add_area(rectangle({}, -ground_m / 2.0, -ground_m / 2.0, ground_m / 2.0, ground_m / 2.0));
  const double density =
      noise.uniform(0.3, 1.2) * ground_m * ground_m / 100.0;  // pieces of each kind in 100 m^2
  const auto count = [&](double share) {
    return static_cast<int>(std::lround(density * share * noise.uniform(0.3, 1.0)));
  };
  for (int i = count(0.5); i > 0; --i)
    add_block(plan, somewhere(ground_m, noise), noise.uniform(2.5, 7.0), noise.uniform(2.0, 5.0));
  for (int i = count(1.5); i > 0; --i)
    plan.add_obstacle(regular_polygon(somewhere(ground_m, noise).position(), noise.uniform(0.1, 0.35), 8));
  for (int i = count(0.4); i > 0; --i)
    add_block(plan, somewhere(ground_m, noise), noise.uniform(3.8, 4.8), noise.uniform(1.7, 1.9));
  for (int i = count(0.5); i > 0; --i)
    add_block(plan, somewhere(ground_m, noise), noise.uniform(2.0, 8.0), 0.08);
  return plan;
}

}  // namespace swiftlet

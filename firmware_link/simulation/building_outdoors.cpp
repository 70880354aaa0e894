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

/// Bounds of the sides of a block, in metres.
struct BlockSize {
  double min_length_m;
  double max_length_m;
  double min_width_m;
  double max_width_m;
};
constexpr BlockSize kHouse{2.5, 7.0, 2.0, 5.0};
constexpr BlockSize kCar{3.8, 4.8, 1.7, 1.9};
constexpr BlockSize kFence{2.0, 8.0, 0.08, 0.08};

void add_block(BuildingPlan& plan, double ground_m, const BlockSize& size, NoiseSource& noise) {
  const Pose2 T_world_block = somewhere(ground_m, noise);
  const double half_length_m = 0.5 * noise.uniform(size.min_length_m, size.max_length_m);
  const double half_width_m = 0.5 * noise.uniform(size.min_width_m, size.max_width_m);
  plan.add_obstacle(rectangle(T_world_block, -half_length_m, -half_width_m, half_length_m, half_width_m));
}

void add_tree(BuildingPlan& plan, double ground_m, NoiseSource& noise) {
  const Point2 at = somewhere(ground_m, noise).position();
  plan.add_obstacle(regular_polygon(at, noise.uniform(0.1, 0.35), 8));
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
  for (int i = 1 + count(0.5); i > 0; --i) add_block(plan, ground_m, kHouse, noise);
  for (int i = 1 + count(1.5); i > 0; --i) add_tree(plan, ground_m, noise);
  for (int i = count(0.4); i > 0; --i) add_block(plan, ground_m, kCar, noise);
  for (int i = count(0.5); i > 0; --i) add_block(plan, ground_m, kFence, noise);
  return plan;
}

}  // namespace swiftlet

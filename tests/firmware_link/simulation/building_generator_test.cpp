// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/building_generator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "firmware_link/simulation/building_flight.hpp"
#include "firmware_link/simulation/building_kinds.hpp"
#include "firmware_link/simulation/sensor_errors.hpp"
#include "tests/support/flown_states.hpp"

namespace swiftlet {
namespace {

constexpr std::uint64_t kSeeds = 200;

const std::vector<SimulatedWorld>& buildings() {
  static const std::vector<SimulatedWorld> kBuildings = [] {
    std::vector<SimulatedWorld> drawn;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) drawn.push_back(draw_building(seed));
    return drawn;
  }();
  return kBuildings;
}

/// Of the length of all walls, the largest share that lies within 5 degrees of one direction or at right
/// angles to it.
double share_along_one_axis(const std::vector<WallSegment>& walls) {
  std::vector<double> length_by_degree(90, 0.0);
  double total_m = 0.0;
  for (const WallSegment& wall : walls) {
    const double degree = std::fmod(degrees(bearing_rad(wall.start, wall.end)) + 360.0, 90.0);
    length_by_degree.at(static_cast<std::size_t>(degree) % 90) += distance_m(wall.start, wall.end);
    total_m += distance_m(wall.start, wall.end);
  }
  double best_m = 0.0;
  for (std::size_t axis = 0; axis < 90; ++axis) {
    double sum_m = 0.0;
    for (std::size_t k = 85; k <= 95; ++k) sum_m += length_by_degree[(axis + k) % 90];
    best_m = std::max(best_m, sum_m);
  }
  return best_m / total_m;
}

double clearance_m(const std::vector<WallSegment>& walls, const Point2& point) {
  double nearest_m = INFINITY;
  for (const WallSegment& wall : walls) nearest_m = std::min(nearest_m, distance_m(wall, point));
  return nearest_m;
}

bool is_same(const SimulatedWorld& a, const SimulatedWorld& b) {
  const auto same_place = [](const Waypoint& v, const Waypoint& w) {
    return v.position.x_m == w.position.x_m && v.position.y_m == w.position.y_m && v.spin_rad == w.spin_rad;
  };
  const auto same_wall = [](const WallSegment& v, const WallSegment& w) {
    return v.start.x_m == w.start.x_m && v.end.y_m == w.end.y_m && v.surface == w.surface;
  };
  return std::ranges::equal(a.flight, b.flight, same_place) &&
         std::ranges::equal(a.walls, b.walls, same_wall);
}

TEST(DrawnBuildings, AreTheSameForTheSameSeedOnly) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    EXPECT_TRUE(is_same(draw_building(seed), draw_building(seed)));
    EXPECT_FALSE(is_same(draw_building(seed), draw_building(seed + 1)));
  }
}

TEST(DrawnBuildings, ShareNoCommonAxisInHalfOfTheSeeds) {
  const auto without_axis = std::ranges::count_if(
      buildings(), [](const SimulatedWorld& world) { return share_along_one_axis(world.walls) < 0.7; });
  EXPECT_GE(without_axis, kSeeds * 4 / 10);
  EXPECT_LE(without_axis, kSeeds * 6 / 10);
}

TEST(DrawnBuildings, AreOfEveryKindWithGlassDarkWallsAndSlipperyFloors) {
  std::map<std::string_view, int> kinds;
  int with_glass = 0;
  int with_dark_walls = 0;
  int with_patches = 0;
  for (const SimulatedWorld& world : buildings()) {
    ++kinds[world.kind];
    const auto has = [&](WallSurface surface) {
      return std::ranges::find(world.walls, surface, &WallSegment::surface) != world.walls.end();
    };
    with_glass += has(WallSurface::kGlass) ? 1 : 0;
    with_dark_walls += has(WallSurface::kDark) ? 1 : 0;
    with_patches += world.floor_patches.empty() ? 0 : 1;
  }
  for (const BuildingKind& kind : building_kinds()) EXPECT_GE(kinds[kind.name], 4) << kind.name;
  EXPECT_GT(with_glass, 20);
  EXPECT_GT(with_dark_walls, 20);
  EXPECT_GT(with_patches, 40);
}

TEST(DrawnBuildings, AreFlownThroughFreeSpaceFor60To400Seconds) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const SimulatedWorld& world = buildings()[seed];
    for (std::size_t i = 0; i < world.flight.size(); ++i) {
      ASSERT_GE(clearance_m(world.walls, world.flight[i].position), FreeSpaceGrid::kMarginM) << seed;
      const WallSegment leg{world.flight[i].position, world.flight[i == 0 ? 1 : i - 1].position};
      for (const WallSegment& wall : world.walls) ASSERT_GT(distance_m(wall, leg), 0.2) << seed;
    }
    SimulatedFlight flight(world, drawn_pilot(seed), seed);
    double flown_s = 0.0;
    double nearest_m = INFINITY;
    for (int step = 0; !flight.is_over(); ++step, flight.step(), flown_s += 0.01)
      if (step % 25 == 0)
        nearest_m = std::min(nearest_m, clearance_m(world.walls, flight.state().T_world_body.position()));
    EXPECT_GT(nearest_m, 0.25) << seed;
    EXPECT_GT(flown_s, 45.0) << seed;
    EXPECT_LT(flown_s, 440.0) << seed;
  }
}

TEST(DrawnBuildings, AreEnclosedButForOpenGround) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SimulatedWorld world = buildings()[seed];
    if (world.kind == "outdoors") continue;
    for (WallSegment& wall : world.walls) wall.surface = WallSurface::kPlain;
    for (std::size_t i = 0; i < world.flight.size(); i += 5)
      for (int degree = 0; degree < 360; degree += 5)
        ASSERT_TRUE(cast_ray(world.walls, world.flight[i].position, radians(degree), 300.0)) << seed;
  }
}

}  // namespace
}  // namespace swiftlet

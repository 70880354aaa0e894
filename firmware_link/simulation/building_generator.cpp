// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/building_generator.hpp"

#include <array>
#include <cmath>

#include "firmware_link/simulation/building_flight.hpp"
#include "firmware_link/simulation/building_kinds.hpp"

namespace swiftlet {
namespace {

constexpr std::array kBuildingKinds{
    BuildingKind{"offices", true, false, draw_offices},
    BuildingKind{"wings", false, true, draw_wings},
    BuildingKind{"curved corridors", false, true, draw_curved_corridors},
    BuildingKind{"polygonal corridors", false, true, draw_polygonal_corridors},
    BuildingKind{"long loop", true, true, draw_long_loop},
    BuildingKind{"pillar hall", true, true, draw_pillar_hall},
    BuildingKind{"cluttered rooms", true, true, draw_cluttered_rooms},
    BuildingKind{"warehouse", true, true, draw_warehouse},
    BuildingKind{"maze", true, true, draw_maze},
    BuildingKind{"symmetrical", true, true, draw_symmetrical},
    BuildingKind{"outdoors", false, true, draw_outdoors},
};

/// Some buildings that may have several directions come out with one after all.
constexpr double kOneDirectionShare = 0.46;

const BuildingKind& draw_kind(WallDirections directions, NoiseSource& noise) {
  while (true) {
    const auto i =
        static_cast<std::size_t>(whole_between(noise, 0, static_cast<int>(kBuildingKinds.size()) - 1));
    const bool fits = directions == WallDirections::kOne ? kBuildingKinds[i].can_have_one_direction
                                                         : kBuildingKinds[i].can_have_several;
    if (fits) return kBuildingKinds[i];
  }
}

/// Glass and dark walls, in a part of the buildings.
void draw_surfaces(std::vector<WallSegment>& walls, NoiseSource& noise) {
  const double glass = noise.chance(0.3) ? noise.uniform(0.03, 0.3) : 0.0;
  const double dark = noise.chance(0.3) ? noise.uniform(0.05, 0.5) : 0.0;
  for (WallSegment& wall : walls) {
    const double fate = noise.uniform(0.0, 1.0);
    if (fate < glass)
      wall.surface = WallSurface::kGlass;
    else if (fate < glass + dark)
      wall.surface = WallSurface::kDark;
  }
}

/// On the way, in a part of the buildings.
std::vector<FloorPatch> draw_floor(const std::vector<Waypoint>& flight, NoiseSource& noise) {
  std::vector<FloorPatch> patches;
  if (!noise.chance(0.35)) return patches;
  for (int count = whole_between(noise, 1, 4); count > 0; --count) {
    const auto i = static_cast<std::size_t>(whole_between(noise, 0, static_cast<int>(flight.size()) - 1));
    patches.push_back({flight[i].position, noise.uniform(0.5, 2.5), noise.uniform(0.5, 1.15)});
  }
  return patches;
}

}  // namespace

std::span<const BuildingKind> building_kinds() { return kBuildingKinds; }

double side_m(const BuildingWish& wish, NoiseSource& noise, double min_share, double max_share) {
  const double whole_m = std::sqrt(wish.way_m) * noise.uniform(0.8, 1.6);
  return whole_m * noise.uniform(min_share, max_share);
}

SimulatedWorld draw_building(std::uint64_t seed) {
  NoiseSource noise(seed, "building");
  const double duration_s = noise.uniform(60.0, 400.0);
  const PilotModel pilot = drawn_pilot(seed);
  const WallDirections directions =
      noise.chance(kOneDirectionShare) ? WallDirections::kOne : WallDirections::kSeveral;
  const BuildingKind& kind = draw_kind(directions, noise);
  BuildingPlan plan = kind.draw({.directions = directions, .way_m = pilot.speed_m_s * duration_s}, noise);
  plan.transform(Pose2(0.0, 0.0, noise.uniform(-kPi, kPi)));
  FreeSpaceGrid grid(plan);
  NoiseSource flight_noise(seed, "building_flight");
  NoiseSource surface_noise(seed, "building_surfaces");
  SimulatedWorld world{
      .walls = plan.walls(), .flight = draw_flight(grid, pilot, duration_s, flight_noise), .kind = kind.name};
  draw_surfaces(world.walls, surface_noise);
  world.floor_patches = draw_floor(world.flight, surface_noise);
  return world;
}

}  // namespace swiftlet

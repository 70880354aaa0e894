// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "firmware_link/simulation/building_plan.hpp"
#include "firmware_link/simulation/random.hpp"

namespace swiftlet {

/// Whether the walls of a building share one direction, up to right angles, or run in several or in curves.
enum class WallDirections : std::uint8_t { kOne, kSeveral };

/// What a building is drawn for.
struct BuildingWish {
  WallDirections directions = WallDirections::kOne;
  double way_m = 100.0;  ///< that will be flown: how large it may be
};

/// A kind of building: one row of the table in building_generator.cpp.
struct BuildingKind {
  std::string_view name;
  bool can_have_one_direction = true;
  bool can_have_several = true;
  BuildingPlan (*draw)(const BuildingWish& wish, NoiseSource& noise) = nullptr;
};
[[nodiscard]] std::span<const BuildingKind> building_kinds();

// Draws are separate statements throughout: the order in which arguments and operands are evaluated is the
// compiler's choice.

/// The side of a building that can be seen in such a flight, or a share of it, evenly between the two.
[[nodiscard]] double side_m(const BuildingWish& wish, NoiseSource& noise, double min_share = 1.0,
                            double max_share = 1.0);

// building_corridors.cpp
[[nodiscard]] BuildingPlan draw_offices(const BuildingWish& wish, NoiseSource& noise);
[[nodiscard]] BuildingPlan draw_wings(const BuildingWish& wish, NoiseSource& noise);
[[nodiscard]] BuildingPlan draw_curved_corridors(const BuildingWish& wish, NoiseSource& noise);
[[nodiscard]] BuildingPlan draw_polygonal_corridors(const BuildingWish& wish, NoiseSource& noise);
[[nodiscard]] BuildingPlan draw_long_loop(const BuildingWish& wish, NoiseSource& noise);
// building_halls.cpp
[[nodiscard]] BuildingPlan draw_pillar_hall(const BuildingWish& wish, NoiseSource& noise);
[[nodiscard]] BuildingPlan draw_cluttered_rooms(const BuildingWish& wish, NoiseSource& noise);
[[nodiscard]] BuildingPlan draw_warehouse(const BuildingWish& wish, NoiseSource& noise);
[[nodiscard]] BuildingPlan draw_symmetrical(const BuildingWish& wish, NoiseSource& noise);
// building_mazes.cpp
[[nodiscard]] BuildingPlan draw_maze(const BuildingWish& wish, NoiseSource& noise);
// building_outdoors.cpp
[[nodiscard]] BuildingPlan draw_outdoors(const BuildingWish& wish, NoiseSource& noise);

}  // namespace swiftlet

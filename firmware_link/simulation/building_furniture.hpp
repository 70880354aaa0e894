// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include "firmware_link/simulation/building_plan.hpp"

namespace swiftlet {

/// How much stands in a building. Each piece is placed only where it leaves ways around it, so there can be
/// fewer.
struct FurnitureWish {
  int at_walls = 0;  ///< cupboards, shelves, pilasters
  int tables = 0;    ///< four legs, with or without chairs
  int chairs = 0;    ///< by themselves
  int people = 0;    ///< standing
  bool is_askew = false;
};

void furnish(BuildingPlan& plan, const FurnitureWish& wish, NoiseSource& noise);

}  // namespace swiftlet

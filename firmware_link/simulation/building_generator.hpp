// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>

#include "firmware_link/simulation/world.hpp"

namespace swiftlet {

/// The building of that seed with a flight of 60 to 400 s through it. In half of all buildings the walls
/// share no common axis. Every kind, and every trait that a kind can have, comes up in some hundred seeds.
/// Noise sources: "building", "building_surfaces", "building_flight", "building_pilot".
[[nodiscard]] SimulatedWorld draw_building(std::uint64_t seed);

}  // namespace swiftlet

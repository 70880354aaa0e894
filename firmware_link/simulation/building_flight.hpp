// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware_link/simulation/flight.hpp"
#include "firmware_link/simulation/free_space_grid.hpp"
#include "firmware_link/simulation/random.hpp"

namespace swiftlet {

/// How the building of that seed is flown. Noise source: "building_pilot".
[[nodiscard]] PilotModel drawn_pilot(std::uint64_t seed);

/// A flight through a building of about that duration: to places not seen yet, back to places seen before,
/// often the other way round, and with hovering, spins, sidestepping and reversing in between.
[[nodiscard]] std::vector<Waypoint> draw_flight(FreeSpaceGrid& grid, const PilotModel& pilot,
                                                double duration_s, NoiseSource& noise);

}  // namespace swiftlet

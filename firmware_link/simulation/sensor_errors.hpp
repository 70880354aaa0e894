// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>

#include "firmware_link/simulation/vehicle.hpp"
#include "firmware_link/simulation/world.hpp"

namespace swiftlet {

/// The vehicle that flies in that world: in a building drawn at random one with errors drawn at random,
/// elsewhere the usual one. Noise source: "sensor_errors".
///
/// The ranges of a drawn vehicle scatter as measured on the flights olsson and rice (standard deviation of
/// the white noise: 3 to 5 mm under 1.5 m, 7 to 8 to 2 m, 11 to 43 to 2.5 m, 21 to 43 to 3 m, 40 to 68 to 4
/// m; 3 to 15 % of the readings err by more than three of them, 30 to 49 % of those beyond 3 m show nothing
/// that is there), and it tilts as those did (1.5 to 1.9 degrees at the median, 6 to 9.5 at 95 %). They are
/// up to 0.1 s younger and up to 0.2 s older than usual. Dead reckoning ends up 3 % of the way off at the
/// median, over 8 % in a tenth of the flights, as on the real logs.
[[nodiscard]] VehicleModel vehicle_model_in(const SimulatedWorld& world, std::uint64_t seed);

}  // namespace swiftlet

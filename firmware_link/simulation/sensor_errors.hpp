// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>

#include "firmware_link/simulation/vehicle.hpp"
#include "firmware_link/simulation/world.hpp"

namespace swiftlet {

/// The vehicle that flies in that world: in a building drawn at random one with errors drawn at random
/// (docs/simulated_buildings.md), elsewhere the usual one. Noise source: "sensor_errors".
[[nodiscard]] VehicleModel vehicle_model_in(const SimulatedWorld& world, std::uint64_t seed);

}  // namespace swiftlet

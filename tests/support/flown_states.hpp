// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <vector>

#include "firmware_link/simulation/flight.hpp"

namespace swiftlet {

/// All states of a simulated flight, kFlightStep apart.
inline std::vector<FlightState> fly(const SimulatedWorld& world, const PilotModel& pilot,
                                    std::uint64_t seed) {
  SimulatedFlight flight(world, pilot, seed);
  std::vector<FlightState> states{flight.state()};
  while (!flight.is_over()) {
    flight.step();
    states.push_back(flight.state());
  }
  return states;
}

}  // namespace swiftlet

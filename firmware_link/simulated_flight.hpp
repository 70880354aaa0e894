// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/time.hpp"
#include "core/geometry/pose2.hpp"
#include "firmware_link/simulated_world.hpp"

namespace swiftlet {

/// How a flight is flown. The wandering terms are standard deviations of slow, mean-reverting deviations from
/// the script.
struct PilotModel {
  double speed_m_s = 0.5;
  double turn_rate_rad_s = radians(60.0);  ///< at most
  double height_m = 0.5;
  double wander_m = 0.04;
  double wander_yaw_rad = radians(3.0);
  double wander_speed_share = 0.06;  ///< of the speed
  int laps = 1;                      ///< how often the script is flown before landing
};

/// The true motion at one instant.
struct FlightState {
  Pose2 T_world_body;
  double vx_body_m_s = 0.0;
  double vy_body_m_s = 0.0;
  double yaw_rate_rad_s = 0.0;
  double ax_body_m_s2 = 0.0;
  double ay_body_m_s2 = 0.0;
  double height_m = 0.0;  ///< above the floor
};

/// Between two states of a flight.
inline constexpr Duration kFlightStep = std::chrono::milliseconds(10);

/// Flies the world's script from take-off to landing: the states in steps of kFlightStep, the first one on
/// the ground. Noise source: "pilot". Allocates.
[[nodiscard]] std::vector<FlightState> fly(const SimulatedWorld& world, const PilotModel& pilot,
                                           std::uint64_t seed);

}  // namespace swiftlet

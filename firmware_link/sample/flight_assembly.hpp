// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <chrono>

#include "core/sensing/flight_limits.hpp"
#include "firmware_link/sample/sample_assembler.hpp"

namespace swiftlet {

/// Ten times as far as the firmware's estimator lets its position go.
inline constexpr double kMaxFromBeginningM = 1000.0;

/// How the readings of a Crazyflie become samples.
[[nodiscard]] inline AssemblyConfig flight_assembly(const SensorModel& sensor) {
  // After a second without the radio the vehicle gives up the link, and so does the source: the motion
  // meanwhile is a guess. The estimate runs on aboard, so the guess is good if the vehicle can have flown the
  // step across the hole; after longer than a battery lasts it has landed and may have been carried.
  constexpr Duration kBatteryLasts = std::chrono::minutes(10);
  // The Multiranger's driver measures every 100 ms, however often its ranges are logged. 5 ms less: two
  // packets of a log at 10 Hz may lie a little closer, and then equal distances are two measurements.
  constexpr Duration kMeasurementPeriod = std::chrono::milliseconds(95);
  AssemblyConfig config;
  config.beams = BeamLayout::multiranger();
  config.sensor = sensor;
  config.continuity.longest_silence = kBatteryLasts;
  config.continuity.farthest_m = kMaxFromBeginningM;
  config.continuity.unwatched_after = kUnwatchedAfter;
  config.measurement_period = kMeasurementPeriod;
  return config;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/time.hpp"
#include "firmware_link/simulation/random.hpp"

namespace swiftlet {

/// The firmware's limits for a low and a critical battery, the parameters pm.lowVoltage and
/// pm.criticalLowVoltage: below them for 5 s.
struct BatteryLimits {
  double low_v = 3.2;
  double critical_v = 3.0;
};

/// A 250 mAh cell: 4.15 V at rest, 0.3 V less under load, empty after its endurance in flight, with a drop at
/// the end. Noise source: "battery". One thread at a time.
class SimulatedBattery {
 public:
  SimulatedBattery(Duration endurance, std::uint64_t seed) : endurance_(endurance), noise_(seed, "battery") {}

  /// A fresh cell.
  void replace(Duration flown);
  /// Measures at `now`, after `flown` in the air since the start of the simulation, under load or not.
  void update(Duration now, Duration flown, bool is_under_load, const BatteryLimits& limits);

  [[nodiscard]] double volts() const { return volts_; }
  [[nodiscard]] double percent() const { return percent_; }
  [[nodiscard]] bool is_low() const { return is_low_; }
  /// Whether the firmware switches the vehicle off.
  [[nodiscard]] bool is_critical() const { return is_critical_; }

 private:
  Duration endurance_;
  NoiseSource noise_;
  Duration flown_when_new_{0};
  std::optional<Duration> below_low_since_;
  std::optional<Duration> below_critical_since_;
  double volts_ = 0.0;
  double percent_ = 0.0;
  bool is_low_ = false;
  bool is_critical_ = false;
};

}  // namespace swiftlet

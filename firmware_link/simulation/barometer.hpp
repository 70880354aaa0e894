// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>

#include "core/base/time.hpp"
#include "firmware_link/simulation/random.hpp"

namespace swiftlet {

/// A BMP388 as the firmware filters it, in metres of altitude.
struct BarometerModel {
  double noise_sigma_m = 0.1;  ///< white, at ten readings a second
  /// Weather and warmth: a mean-reverting walk from 0, after a minute 0.3 m, after ten 0.84 m. Its standard
  /// deviation in the long run...
  double drift_sigma_m = 1.2;
  double drift_time_s = 1800.0;  ///< ...and correlation time
};

/// The error of the simulated barometer's altitude. Noise sources: "baro", "baro_drift". One thread at a
/// time; allocates nothing.
class SimulatedBarometer {
 public:
  SimulatedBarometer(const BarometerModel& model, Duration now, std::uint64_t seed);

  /// The readings until `now`.
  void advance(Duration now);
  /// Of the newest reading.
  [[nodiscard]] double error_m() const { return error_m_; }

 private:
  void read();

  BarometerModel model_;
  NoiseSource noise_;
  NoiseSource drift_noise_;
  Duration next_read_;
  double drift_m_ = 0.0;
  double error_m_ = 0.0;
};

}  // namespace swiftlet

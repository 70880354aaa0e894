// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/barometer.hpp"

#include <chrono>
#include <cmath>

namespace swiftlet {
namespace {

constexpr Duration kBarometerPeriod = std::chrono::milliseconds(100);

}  // namespace

SimulatedBarometer::SimulatedBarometer(const BarometerModel& model, Duration now, std::uint64_t seed)
    : model_(model),
      noise_(seed, "baro"),
      drift_noise_(seed, "baro_drift"),
      next_read_(now + kBarometerPeriod),
      error_m_(noise_.gaussian(model.noise_sigma_m)) {}

void SimulatedBarometer::advance(Duration now) {
  for (; next_read_ <= now; next_read_ += kBarometerPeriod) read();
}

/// The drift is an Ornstein-Uhlenbeck process, exact for a fixed step.
void SimulatedBarometer::read() {
  const double keep = std::exp(-to_seconds(kBarometerPeriod) / model_.drift_time_s);
  drift_m_ = keep * drift_m_ + drift_noise_.gaussian(model_.drift_sigma_m * std::sqrt(1.0 - keep * keep));
  error_m_ = drift_m_ + noise_.gaussian(model_.noise_sigma_m);
}

}  // namespace swiftlet

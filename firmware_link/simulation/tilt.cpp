// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/tilt.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "firmware_link/simulation/flight.hpp"

namespace swiftlet {
namespace {

constexpr double kShakeTimeS = 0.3;  // correlation
constexpr double kGustS = 0.8;       // mean duration
constexpr double kOnsetS = 0.2;
constexpr double kFloorWithinM = 3.0;  // a floor farther away returns too little light
constexpr std::size_t kRemembered = std::chrono::seconds(1) / kFlightStep;

}  // namespace

SimulatedTilt::SimulatedTilt(const TiltModel& model, std::uint64_t seed)
    : model_(model), noise_(seed, "tilt"), sigma_rad_(model.calm_rad), recent_(kRemembered) {}

void SimulatedTilt::step(const Tilt& by_motion) {
  const double onset_s = kGustS * (1.0 - model_.gust_share) / model_.gust_share;
  if (noise_.chance(kFlightStepS / (is_gust_ ? kGustS : onset_s))) is_gust_ = !is_gust_;
  sigma_rad_ += ((is_gust_ ? model_.gust_rad : model_.calm_rad) - sigma_rad_) * kFlightStepS / kOnsetS;
  const double keep = std::exp(-kFlightStepS / kShakeTimeS);
  const double kick = std::sqrt(1.0 - keep * keep);
  shaken_.roll_rad = keep * shaken_.roll_rad + noise_.gaussian(kick);
  shaken_.pitch_rad = keep * shaken_.pitch_rad + noise_.gaussian(kick);
  newest_ = (newest_ + 1) % recent_.size();
  recent_[newest_] = {by_motion.roll_rad + sigma_rad_ * shaken_.roll_rad,
                      by_motion.pitch_rad + sigma_rad_ * shaken_.pitch_rad};
}

const Tilt& SimulatedTilt::before(Duration age) const {
  const auto steps = static_cast<std::size_t>(std::max(Duration(0), age) / kFlightStep);
  return recent_[(newest_ + recent_.size() - std::min(steps, recent_.size() - 1)) % recent_.size()];
}

std::optional<double> tilted_range_m(std::optional<double> level_m, double bearing_rad, const Tilt& tilt,
                                     double height_m) {
  const double fall = std::sin(tilt.pitch_rad) * std::cos(bearing_rad) -
                      std::sin(tilt.roll_rad) * std::sin(bearing_rad);  // of the beam, downwards
  if (level_m) level_m = *level_m / std::sqrt(1.0 - fall * fall);
  if (fall > 0.0 && height_m < fall * level_m.value_or(kFloorWithinM)) return height_m / fall;
  return level_m;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/battery.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {
namespace {

constexpr double kFullV = 4.15;
constexpr double kLoadV = 0.3;
constexpr double kSagV = 0.5;
constexpr double kKneeV = 0.35;
constexpr double kSigmaV = 0.008;
constexpr double kFallPerEndurance = 3.0;  // V, beyond the end of the discharge
constexpr Duration kPatience = std::chrono::seconds(5);

bool is_so_for_long(bool is_so, Duration now, std::optional<Duration>& since) {
  if (!is_so) since.reset();
  if (is_so && !since) since = now;
  return since && now - *since >= kPatience;
}

}  // namespace

void SimulatedBattery::replace(Duration flown) {
  flown_when_new_ = flown;
  below_low_since_.reset();
  below_critical_since_.reset();
  is_low_ = is_critical_ = false;
}

void SimulatedBattery::update(Duration now, Duration flown, bool is_under_load, const BatteryLimits& limits) {
  const double drawn = to_seconds(flown - flown_when_new_) / to_seconds(endurance_);
  const double used = std::min(1.0, drawn);
  volts_ = kFullV - (is_under_load ? kLoadV : 0.0) - kSagV * used - kKneeV * std::pow(used, 12.0) -
           kFallPerEndurance * (drawn - used) + noise_.gaussian(kSigmaV);
  percent_ = 100.0 * (1.0 - used);
  is_low_ = is_so_for_long(volts_ < limits.low_v, now, below_low_since_);
  is_critical_ = is_critical_ || is_so_for_long(volts_ < limits.critical_v, now, below_critical_since_);
}

}  // namespace swiftlet

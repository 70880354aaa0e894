// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/barometer.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;

/// Over 400 vehicles.
double sigma_after_m(Duration duration, const BarometerModel& model) {
  double squares = 0.0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SimulatedBarometer barometer(model, Duration(0), seed);
    barometer.advance(duration);
    squares += barometer.error_m() * barometer.error_m();
  }
  return std::sqrt(squares / 400.0);
}

TEST(SimulatedBarometer, ScattersByATenthOfAMetre) {
  EXPECT_NEAR(sigma_after_m(Duration(0), {}), 0.1, 0.02);
  EXPECT_NEAR(sigma_after_m(minutes(1), {.drift_sigma_m = 0.0}), 0.1, 0.02);
}

TEST(SimulatedBarometer, DriftsByAThirdOfAMetreInAMinuteAndByAboutOneInTen) {
  const BarometerModel model{.noise_sigma_m = 0.0};
  EXPECT_NEAR(sigma_after_m(minutes(1), model), 0.3, 0.05);
  EXPECT_NEAR(sigma_after_m(minutes(10), model), 0.85, 0.1);
}

TEST(SimulatedBarometer, DriftsWithinBounds) { EXPECT_LT(sigma_after_m(std::chrono::hours(2), {}), 1.4); }

TEST(SimulatedBarometer, ReadsTenTimesASecond) {
  SimulatedBarometer barometer({}, Duration(0), 1);
  double last_m = barometer.error_m();
  int readings = 0;
  for (int ms = 1; ms <= 10'000; ++ms) {
    barometer.advance(milliseconds(ms));
    if (barometer.error_m() != last_m) ++readings;
    last_m = barometer.error_m();
  }
  EXPECT_EQ(readings, 100);
}

TEST(SimulatedBarometer, IsTheSameForAnyStepsOfTime) {
  SimulatedBarometer at_once({}, Duration(0), 3);
  SimulatedBarometer in_steps({}, Duration(0), 3);
  at_once.advance(minutes(1));
  for (int i = 1; i <= 6000; ++i) in_steps.advance(milliseconds(10 * i));
  EXPECT_EQ(at_once.error_m(), in_steps.error_m());
}

}  // namespace
}  // namespace swiftlet

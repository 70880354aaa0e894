// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/battery.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Flies from the start on, measuring each 100 ms, until `is_enough`; how long that took.
template <typename IsEnough>
double flown_until_s(SimulatedBattery& battery, IsEnough is_enough, const BatteryLimits& limits = {}) {
  Duration now{0};
  while (!is_enough(battery) && now < std::chrono::minutes(20)) {
    now += milliseconds(100);
    battery.update(now, now, true, limits);
  }
  return to_seconds(now);
}

TEST(SimulatedBattery, SagsUnderLoad) {
  SimulatedBattery battery(std::chrono::minutes(8), 1);
  battery.update(seconds(1), seconds(0), false, {});
  EXPECT_NEAR(battery.volts(), 4.15, 0.05);
  battery.update(seconds(2), seconds(0), true, {});
  EXPECT_NEAR(battery.volts(), 3.85, 0.05);
  EXPECT_EQ(battery.percent(), 100.0);
}

TEST(SimulatedBattery, IsLowAndThenCriticalAroundTheEndOfItsEndurance) {
  SimulatedBattery battery(std::chrono::minutes(2), 1);
  const double low_s = flown_until_s(battery, [](const SimulatedBattery& b) { return b.is_low(); });
  EXPECT_FALSE(battery.is_critical());
  EXPECT_GT(low_s, 100.0);
  EXPECT_LT(low_s, 125.0);
  const double empty_s = flown_until_s(battery, [](const SimulatedBattery& b) { return b.is_critical(); });
  EXPECT_GT(empty_s, 120.0);
  EXPECT_LT(empty_s, 135.0);
  EXPECT_EQ(battery.percent(), 0.0);
}

TEST(SimulatedBattery, IsLowOnlyAfter5SecondsBelowTheLimit) {
  SimulatedBattery battery(std::chrono::minutes(8), 1);
  const BatteryLimits limits{.low_v = 4.0, .critical_v = 3.0};
  battery.update(seconds(1), seconds(0), true, limits);
  battery.update(seconds(5), seconds(0), true, limits);
  EXPECT_FALSE(battery.is_low());
  battery.update(seconds(6), seconds(0), true, limits);
  EXPECT_TRUE(battery.is_low());
  battery.update(seconds(7), seconds(0), false, limits);
  EXPECT_FALSE(battery.is_low()) << "the load is off";
}

TEST(SimulatedBattery, IsFullAgainWhenReplaced) {
  SimulatedBattery battery(std::chrono::minutes(1), 1);
  flown_until_s(battery, [](const SimulatedBattery& b) { return b.is_critical(); });
  battery.replace(seconds(70));
  EXPECT_FALSE(battery.is_critical());
  battery.update(seconds(71), seconds(70), false, {});
  EXPECT_NEAR(battery.volts(), 4.15, 0.05);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/laser_log/pose_scan_lag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

constexpr double kStepRad = radians(1.0);
constexpr double kIntervalS = 0.4;

/// What a scanner in the middle of a room of 8 m by 5 m with a pillar sees at this heading, 180 readings.
std::vector<float> scan_at(double yaw_rad) {
  std::vector<float> distances_m;
  for (int i = 0; i < 180; ++i) {
    const double bearing_rad = yaw_rad - kPi / 2.0 + i * kStepRad;
    const double along = 4.0 / std::max(1e-9, std::abs(std::cos(bearing_rad)));
    const double across = 2.5 / std::max(1e-9, std::abs(std::sin(bearing_rad)));
    const bool pillar = std::abs(wrap_angle(bearing_rad - 1.0)) < 0.15;
    distances_m.push_back(static_cast<float>(pillar ? 1.5 : std::min(along, across)));
  }
  return distances_m;
}

double yaw_at(double time_s) { return 1.2 * std::sin(0.35 * time_s) + 0.4 * std::sin(1.1 * time_s); }

/// A log of `lines` whose poses are as new as their scans, or newer.
PoseScanLag lag_of(int lines, double lag_s) {
  PoseScanLag lead;
  for (int i = 0; i < lines; ++i)
    lead.add(scan_at(yaw_at(i * kIntervalS)), yaw_at(i * kIntervalS + lag_s), kStepRad);
  return lead;
}

TEST(TurnedRad, FindsTheTurnToAFractionOfTheStep) {
  for (const double turn_rad : {0.0, radians(0.5), radians(3.0), radians(-7.3), radians(25.0)}) {
    const auto found = turned_rad(scan_at(0.2), scan_at(0.2 + turn_rad), kStepRad);
    ASSERT_TRUE(found) << turn_rad;
    EXPECT_NEAR(*found, turn_rad, 0.4 * kStepRad);
  }
}

TEST(TurnedRad, FindsNothingIfNoTurnAgrees) {
  EXPECT_FALSE(turned_rad(std::vector<float>(180, 3.0F), std::vector<float>(180, 6.0F), kStepRad));
  EXPECT_FALSE(turned_rad(std::vector<float>(180, 81.0F), std::vector<float>(180, 81.0F), kStepRad))
      << "all out of range";
  EXPECT_FALSE(turned_rad(scan_at(0.0), scan_at(radians(60.0)), kStepRad)) << "too wide a turn";
}

TEST(PoseScanLag, DetectsPosesALineAhead) {
  EXPECT_TRUE(lag_of(400, kIntervalS).runs_a_line_ahead());
  EXPECT_TRUE(lag_of(400, 1.3 * kIntervalS).runs_a_line_ahead()) << "or more";
}

TEST(PoseScanLag, DoesNotReportPosesOfTheSameLine) {
  EXPECT_FALSE(lag_of(400, 0.0).runs_a_line_ahead());
  EXPECT_FALSE(lag_of(400, 0.3 * kIntervalS).runs_a_line_ahead());
  EXPECT_FALSE(lag_of(400, -kIntervalS).runs_a_line_ahead()) << "that lag behind, too";
}

TEST(PoseScanLag, ReportsNothingForAShortLogOrOneThatNeverTurns) {
  EXPECT_FALSE(lag_of(60, kIntervalS).runs_a_line_ahead());
  PoseScanLag still;
  for (int i = 0; i < 400; ++i) still.add(scan_at(0.3), 0.3, kStepRad);
  EXPECT_FALSE(still.runs_a_line_ahead());
  EXPECT_EQ(still.difference_rad(), 0.0);
}

TEST(PoseScanLag, ComparesNeighboursOnly) {
  PoseScanLag lead;
  for (int i = 0; i < 800; ++i) {
    if (i % 2 == 0) lead.interrupt();
    lead.add(scan_at(yaw_at(i * kIntervalS)), yaw_at((i + 1) * kIntervalS), kStepRad);
  }
  EXPECT_FALSE(lead.runs_a_line_ahead());
  EXPECT_EQ(lead.difference_rad(), 0.0);
}

}  // namespace
}  // namespace swiftlet

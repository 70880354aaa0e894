// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/calibration/calibration_scan.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace swiftlet {
namespace {

TEST(CalibrationScans, KeepHitsAlone) {
  RangeSample sample;
  sample.measured_at = DeviceTime(std::chrono::seconds(3));
  sample.T_odom_body = Pose2(1.0, 2.0, 0.5);
  sample.starts_segment = true;
  sample.beam_count = 4;
  sample.status = {RangeStatus::kNoReturn, RangeStatus::kHit, RangeStatus::kInvalid, RangeStatus::kHit};
  sample.distance_m = {0.0F, 1.5F, 0.0F, 0.5F};
  const std::vector<CalibrationScan> scans =
      calibration_scans(std::vector{sample}, BeamLayout::multiranger());
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(scans[0].measured_at, sample.measured_at);
  EXPECT_EQ(scans[0].T_odom_body.vector(), sample.T_odom_body.vector());
  EXPECT_TRUE(scans[0].starts_segment);
  ASSERT_EQ(scans[0].hits_body.size(), 2U);
  EXPECT_NEAR(scans[0].hits_body[0].y_m, 1.5, 1e-12);
  EXPECT_NEAR(scans[0].hits_body[1].y_m, -0.5, 1e-12);
}

TEST(SummarizeMotion, AddsUpToAndFroButNotWhatNobodyWatched) {
  const auto scan = [](int second, const Pose2& T, bool starts) {
    return CalibrationScan{DeviceTime(std::chrono::seconds(second)), T, starts, {}};
  };
  const std::vector<CalibrationScan> scans{
      scan(0, Pose2(), true), scan(1, Pose2(1.0, 0.5, 0.0), false), scan(2, Pose2(0.0, 0.5, 0.3), false),
      scan(60, Pose2(9.0, 9.0, 2.0), true), scan(61, Pose2(9.0, 9.0, 1.5), false)};
  const MotionSummary summary = summarize_motion(scans);
  EXPECT_NEAR(summary.duration_s, 3.0, 1e-9);
  EXPECT_NEAR(summary.forward_m, 2.0, 1e-9);
  EXPECT_NEAR(summary.sideways_m, 0.5, 1e-9);
  EXPECT_NEAR(summary.turned_rad, 0.8, 1e-9);
}

}  // namespace
}  // namespace swiftlet

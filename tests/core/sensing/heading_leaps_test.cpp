// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/heading_leaps.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "core/geometry/angle.hpp"
#include "tests/support/pose_near.hpp"

namespace swiftlet {
namespace {

constexpr std::chrono::milliseconds kUsualPeriod(100);

/// Flown at 0.5 m/s with these turns from sample to sample, in degrees.
std::vector<RangeSample> flown(const std::vector<double>& turns_deg, Duration period = kUsualPeriod) {
  std::vector<RangeSample> samples(1);
  for (const double turn_deg : turns_deg) {
    RangeSample next = samples.back();
    next.measured_at += period;
    next.stamp += period;
    next.T_odom_body = next.T_odom_body * Pose2(0.5 * to_seconds(period), 0.0, radians(turn_deg));
    samples.push_back(next);
  }
  samples.front().starts_segment = true;
  return samples;
}

struct MendedFlight {
  std::vector<RangeSample> samples;
  std::size_t leaps = 0;
  std::vector<MendedOdometry> mended;
};

MendedFlight flown_without_leaps(std::vector<RangeSample> samples) {
  HeadingLeaps leaps;
  for (RangeSample& sample : samples) leaps.mend(sample);
  return {std::move(samples), leaps.count(), leaps.mended()};
}

void expect_same_path(const std::vector<RangeSample>& a, const std::vector<RangeSample>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_TRUE(poses_near(a[i].T_odom_body, b[i].T_odom_body, 1e-9, 1e-9)) << i;
}

TEST(HeadingLeaps, TakesOutALeapFromOneSampleToTheNext) {
  const MendedFlight mending = flown_without_leaps(flown({0, 1, 0, 20, 0, 0, -30, 0, 0}));
  EXPECT_EQ(mending.leaps, 2U);
  expect_same_path(mending.samples, flown({0, 1, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(HeadingLeaps, TakesOutALeapThatLiesBetweenTwoSamples) {
  const MendedFlight mending = flown_without_leaps(flown({0, 0, 12, 18, 0, 0}));
  EXPECT_EQ(mending.leaps, 1U);
  expect_same_path(mending.samples, flown({0, 0, 0, 0, 0, 0}));
}

TEST(HeadingLeaps, TheVehicleTurnsOnAtItsRate) {
  const MendedFlight mending = flown_without_leaps(flown({5, 5, 5, -25, 5, 5}));
  EXPECT_EQ(mending.leaps, 1U);
  expect_same_path(mending.samples, flown({5, 5, 5, 5, 5, 5}));
}

TEST(HeadingLeaps, WhatAVehicleCanTurnStays) {
  const std::vector<RangeSample> reported = flown({0, 7, 14, 21, 14, 0, -7, 0, 2});
  const MendedFlight mending = flown_without_leaps(reported);
  EXPECT_EQ(mending.leaps, 0U);
  EXPECT_TRUE(mending.mended.empty());
  for (std::size_t i = 0; i < reported.size(); ++i)
    EXPECT_EQ(mending.samples[i].T_odom_body.vector(), reported[i].T_odom_body.vector()) << "to the bit";
}

TEST(HeadingLeaps, BrakingIsNoLeap) {
  const MendedFlight mending = flown_without_leaps(flown({0, 7, 12, 0, 0, 0}));
  EXPECT_TRUE(mending.mended.empty()) << "as at a real take-off: 12 degrees less from one step to the next";
}

TEST(HeadingLeaps, ATurnThatGoesOnIsGivenBack) {
  const std::vector<RangeSample> reported = flown({0, 0, 15, 15, 15, 15, 0, 0});
  const MendedFlight mending = flown_without_leaps(reported);
  EXPECT_EQ(mending.leaps, 0U);
  EXPECT_NEAR(mending.samples[4].T_odom_body.yaw_rad(), 0.0, 1e-9) << "held back";
  for (const std::size_t i : {5U, 8U})
    EXPECT_NEAR(mending.samples[i].T_odom_body.yaw_rad(), reported[i].T_odom_body.yaw_rad(), 1e-9) << i;
}

TEST(HeadingLeaps, StepsOfHalfASecondShowNothing) {
  EXPECT_TRUE(flown_without_leaps(flown({0, 120, 0, 0}, 5 * kUsualPeriod)).mended.empty());
}

TEST(HeadingLeaps, NothingIsKnownOfDeadReckoningThatBeginsAnew) {
  std::vector<RangeSample> samples = flown({0, 0, 90, 0, 0, 20, 0});
  samples[3].starts_segment = true;
  const MendedFlight mending = flown_without_leaps(samples);
  EXPECT_EQ(mending.leaps, 1U) << "the one behind it";
  EXPECT_EQ(mending.samples[5].T_odom_body.vector(), samples[5].T_odom_body.vector());
}

TEST(HeadingLeaps, GivesBackWhatWasReported) {
  std::vector<RangeSample> reported = flown({0, 20, 0, 0, 15, 15, 15, 0, 40, 0, 0, 0, -25, 0});
  reported[11].starts_segment = true;
  const MendedFlight mending = flown_without_leaps(reported);
  EXPECT_EQ(mending.leaps, 3U);
  for (std::size_t i = 0; i < reported.size(); ++i)
    EXPECT_TRUE(poses_near(as_reported(mending.mended, reported[i].stamp, mending.samples[i].T_odom_body),
                           reported[i].T_odom_body, 1e-9, 1e-9))
        << i;
}

TEST(HeadingLeaps, AnEstimateThatLeapsAllTheTimeIsPassedOnAsItIs) {
  std::vector<double> turns_deg;
  for (int i = 0; i < 1000; ++i) turns_deg.insert(turns_deg.end(), {20.0, 0.0, 0.0});
  const std::vector<RangeSample> reported = flown(turns_deg);
  const MendedFlight mending = flown_without_leaps(reported);
  EXPECT_LE(mending.mended.size(), 301U);
  const Pose2 last_step = between(mending.samples[2998].T_odom_body, mending.samples[3000].T_odom_body);
  EXPECT_TRUE(
      poses_near(last_step, between(reported[2998].T_odom_body, reported[3000].T_odom_body), 1e-9, 1e-9));
  EXPECT_TRUE(poses_near(as_reported(mending.mended, reported[3000].stamp, mending.samples[3000].T_odom_body),
                         reported[3000].T_odom_body, 1e-9, 1e-9));
}

}  // namespace
}  // namespace swiftlet

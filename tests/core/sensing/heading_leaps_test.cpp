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

TEST(HeadingLeaps, TakesOutALeapThatLiesAnywhereBetweenTwoSamples) {
  for (const double leap_deg : {20.0, -30.0, 90.0})
    for (const double rate_deg : {0.0, 5.0, -10.0})
      for (int twentieths = 0; twentieths <= 20; ++twentieths) {
        const double share = twentieths / 20.0;
        std::vector<double> turns_deg(8, rate_deg);
        turns_deg[3] += share * leap_deg;
        turns_deg[4] += (1.0 - share) * leap_deg;
        const MendedFlight mending = flown_without_leaps(flown(turns_deg));
        EXPECT_EQ(mending.leaps, 1U) << leap_deg << ' ' << rate_deg << ' ' << share;
        const double last_rad = mending.samples.back().T_odom_body.yaw_rad();
        EXPECT_NEAR(wrap_angle(last_rad - radians(8.0 * rate_deg)), 0.0, radians(4.1))
            << leap_deg << ' ' << rate_deg << ' ' << share;
      }
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

TEST(HeadingLeaps, ATwistAtATakeOffIsNoLeap) {
  const std::vector<double> turns_deg{0,   -2.5, -6.9, -11.3, 1.2,
                                      3.5, 3.7,  1.6,  1.7,   1.4};  // of a real flight
  EXPECT_TRUE(flown_without_leaps(flown(turns_deg)).mended.empty());
}

TEST(HeadingLeaps, ATurnThatGoesOnIsGivenBack) {
  const std::vector<RangeSample> reported = flown({0, 0, 15, 15, 15, 15, 0, 0});
  const MendedFlight mending = flown_without_leaps(reported);
  EXPECT_EQ(mending.leaps, 0U);
  EXPECT_NEAR(mending.samples[4].T_odom_body.yaw_rad(), 0.0, 1e-9) << "held back";
  for (const std::size_t i : {5U, 8U})
    EXPECT_NEAR(mending.samples[i].T_odom_body.yaw_rad(), reported[i].T_odom_body.yaw_rad(), 1e-9) << i;
}

TEST(HeadingLeaps, AShortTurnThatAVehicleCanFlyStays) {
  for (const std::vector<double>& turns_deg : std::vector<std::vector<double>>{{0, 5, 0, 0}, {0, 7, 8, 0, 0}})
    EXPECT_TRUE(flown_without_leaps(flown(turns_deg)).mended.empty());
}

TEST(HeadingLeaps, WhereNothingCanBeToldWhatIsHeldBackIsGivenBack) {
  std::vector<RangeSample> reported = flown({0, 0, 12, 0, 0, 0});
  for (std::size_t i = 4; i < reported.size(); ++i) reported[i].measured_at += std::chrono::milliseconds(400);
  const MendedFlight mending = flown_without_leaps(reported);
  EXPECT_EQ(mending.leaps, 0U);
  EXPECT_NEAR(mending.samples[3].T_odom_body.yaw_rad(), 0.0, 1e-9) << "held back";
  EXPECT_NEAR(mending.samples[4].T_odom_body.yaw_rad(), radians(12.0), 1e-9);
}

TEST(HeadingLeaps, AcrossHalfATurnToo) {
  const MendedFlight mending = flown_without_leaps(flown({10, 10, 160, 10, 25, 10, 10}));
  EXPECT_EQ(mending.leaps, 2U);
  EXPECT_NEAR(mending.samples.back().T_odom_body.yaw_rad(), radians(70.0), 1e-9);
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

TEST(HeadingLeaps, WhatIsHeldBackIsNotGivenBackToDeadReckoningThatBeginsAnew) {
  std::vector<RangeSample> samples = flown({0, 0, 90, 0, 0});
  samples[4].starts_segment = true;
  const MendedFlight mending = flown_without_leaps(samples);
  EXPECT_NEAR(mending.samples[3].T_odom_body.yaw_rad(), 0.0, 1e-9) << "held back";
  EXPECT_EQ(mending.samples[5].T_odom_body.vector(), samples[5].T_odom_body.vector());
}

TEST(HeadingLeaps, GivesBackWhatWasReported) {
  std::vector<RangeSample> reported = flown({0, 20, 0, 0, 15, 15, 15, 0, 0, 0, 40, 0, 0, 0, -25, 0});
  reported[13].starts_segment = true;
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

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/sensing/quick_restarts.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <vector>

#include "core/sensing/flight_limits.hpp"
#include "tests/support/pose_near.hpp"

namespace swiftlet {
namespace {

constexpr std::chrono::milliseconds kPeriod(100);
constexpr std::size_t kRestart = 6;

/// Along a curve at 0.5 m/s, or standing.
std::vector<RangeSample> flown(const Pose2& step = Pose2(0.05, 0.0, 0.04)) {
  std::vector<RangeSample> samples(12);
  samples.front().starts_segment = true;
  samples.front().T_odom_body = Pose2(3.0, -2.0, 1.0);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    samples[i].measured_at = samples[i - 1].measured_at + kPeriod;
    samples[i].stamp = samples[i - 1].stamp + kPeriod;
    samples[i].T_odom_body = samples[i - 1].T_odom_body * step;
  }
  return samples;
}

/// From sample `from` on the estimate is that of a vehicle that began there.
void restart_at(std::size_t from, std::vector<RangeSample>& samples) {
  const Pose2 T_odom_new = samples[from].T_odom_body;
  samples[from].starts_segment = true;
  for (std::size_t i = from; i < samples.size(); ++i)
    samples[i].T_odom_body = between(T_odom_new, samples[i].T_odom_body);
}

std::vector<RangeSample> mended(std::vector<RangeSample> samples, QuickRestarts& restarts) {
  for (RangeSample& sample : samples) restarts.mend(sample);
  return samples;
}

/// Whether all samples are delivered as they were reported.
bool are_left(const std::vector<RangeSample>& reported) {
  QuickRestarts restarts;
  const std::vector<RangeSample> delivered = mended(reported, restarts);
  for (std::size_t i = 0; i < reported.size(); ++i)
    if (!poses_near(delivered[i].T_odom_body, reported[i].T_odom_body, 0.0, 0.0) ||
        delivered[i].starts_segment != reported[i].starts_segment ||
        delivered[i].odometry_ran_on != reported[i].odometry_ran_on)
      return false;
  return true;
}

TEST(QuickRestarts, AreJoinedInFlight) {
  std::vector<RangeSample> reported = flown();
  restart_at(kRestart, reported);
  QuickRestarts restarts;
  const std::vector<RangeSample> delivered = mended(reported, restarts);
  EXPECT_EQ(restarts.count(), 1U);
  const std::vector<RangeSample> truth = flown();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_TRUE(poses_near(delivered[i].T_odom_body, truth[i].T_odom_body, 1e-9, 1e-9)) << i;
    EXPECT_TRUE(poses_near(as_reported(restarts.mended(), reported[i].stamp, delivered[i].T_odom_body),
                           reported[i].T_odom_body, 1e-9, 1e-9))
        << i;
    EXPECT_EQ(delivered[i].starts_segment, i == 0) << i;
  }
}

TEST(QuickRestarts, AreJoinedAcrossALostSampleToo) {
  std::vector<RangeSample> truth = flown();
  std::vector<RangeSample> reported = truth;
  restart_at(kRestart, reported);
  reported.erase(reported.begin() + kRestart);
  reported[kRestart].starts_segment = true;
  truth.erase(truth.begin() + kRestart);
  QuickRestarts restarts;
  const std::vector<RangeSample> delivered = mended(reported, restarts);
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_TRUE(poses_near(delivered[i].T_odom_body, truth[i].T_odom_body, 1e-4, 1e-9)) << i;
}

TEST(QuickRestarts, AreLeftWhereTheVehicleStood) {
  for (const Pose2& noise : {Pose2(), Pose2(0.004, -0.005, 0.004)}) {
    std::vector<RangeSample> reported = flown(noise);
    restart_at(kRestart, reported);
    EXPECT_TRUE(are_left(reported)) << "it may have been carried";
  }
}

TEST(QuickRestarts, AreLeftWhereTheEstimateHadRunAway) {
  std::vector<RangeSample> reported = flown(Pose2(0.6, 0.0, 0.0));
  restart_at(kRestart, reported);
  EXPECT_TRUE(are_left(reported));
}

TEST(QuickRestarts, AreLeftWhereTheStepBeforeWasMuchShorter) {
  std::vector<RangeSample> reported = flown();
  restart_at(kRestart, reported);
  reported[kRestart - 1].measured_at = reported[kRestart - 2].measured_at + std::chrono::milliseconds(20);
  EXPECT_TRUE(are_left(reported));
}

TEST(QuickRestarts, AreLeftAfterASecondByEitherClock) {
  for (const bool by_vehicle : {true, false}) {
    std::vector<RangeSample> reported = flown();
    restart_at(kRestart, reported);
    for (std::size_t i = kRestart; i < reported.size(); ++i) {
      reported[i].stamp += kUnwatchedAfter;
      if (by_vehicle) reported[i].measured_at += kUnwatchedAfter;
    }
    EXPECT_TRUE(are_left(reported)) << by_vehicle;
  }
}

TEST(QuickRestarts, AreLeftWhereTheVehiclesClockBeganAnew) {
  std::vector<RangeSample> reported = flown();
  restart_at(kRestart, reported);
  for (std::size_t i = kRestart; i < reported.size(); ++i) reported[i].measured_at -= std::chrono::seconds(2);
  EXPECT_TRUE(are_left(reported));
}

TEST(QuickRestarts, AreLeftWhereNoStepWasMeasuredBefore) {
  std::vector<RangeSample> reported = flown();
  restart_at(1, reported);
  restart_at(2, reported);
  EXPECT_TRUE(are_left(reported));
}

TEST(QuickRestarts, AreLeftWhereTheStepBeforeWasAGuessItself) {
  std::vector<RangeSample> reported = flown();
  restart_at(kRestart, reported);
  restart_at(kRestart + 1, reported);
  QuickRestarts restarts;
  EXPECT_TRUE(mended(reported, restarts)[kRestart + 1].starts_segment);
  EXPECT_EQ(restarts.count(), 1U);
}

TEST(QuickRestarts, ASilenceIsNoRestart) {
  std::vector<RangeSample> reported = flown();
  reported[kRestart].starts_segment = true;
  reported[kRestart].odometry_ran_on = true;
  EXPECT_TRUE(are_left(reported));
}

TEST(QuickRestarts, ALongOneBehindThemIsPassedOnAsReported) {
  std::vector<RangeSample> reported = flown();
  restart_at(kRestart, reported);
  restart_at(kRestart + 3, reported);
  for (std::size_t i = kRestart + 3; i < reported.size(); ++i) {
    reported[i].stamp += std::chrono::minutes(1);
    reported[i].measured_at += std::chrono::minutes(1);
  }
  QuickRestarts restarts;
  const std::vector<RangeSample> delivered = mended(reported, restarts);
  EXPECT_EQ(restarts.count(), 1U);
  for (std::size_t i = kRestart + 3; i < reported.size(); ++i)
    EXPECT_TRUE(poses_near(delivered[i].T_odom_body, reported[i].T_odom_body, 1e-12, 1e-12)) << i;
}

TEST(QuickRestarts, AnEstimateThatRestartsAllTheTimeIsPassedOnAsItIs) {
  std::vector<RangeSample> samples = flown();
  QuickRestarts restarts;
  const MendedOdometry* const records = restarts.mended().data();
  for (RangeSample& sample : samples) restarts.mend(sample);
  const RangeSample last = samples.back();
  for (int i = 0; i < 1000; ++i) {
    RangeSample moved = last;
    moved.measured_at += (i + 1) * kPeriod;
    moved.stamp += (i + 1) * kPeriod;
    moved.T_odom_body = Pose2(0.01 * i, 0.0, 0.0);
    moved.starts_segment = i % 2 == 1;
    restarts.mend(moved);
  }
  EXPECT_EQ(restarts.mended().size(), MendedFrame::kMostChanges);
  EXPECT_EQ(restarts.mended().data(), records) << "no allocation in flight";
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/sample/motion_mending_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/angle.hpp"
#include "core/sensing/quick_restarts.hpp"
#include "firmware_link/input/open_sample_source.hpp"
#include "firmware_link/sample/flight_assembly.hpp"
#include "firmware_link/sample/input_counters.hpp"
#include "firmware_link/sample/sample_assembler.hpp"
#include "firmware_link/sample/sign_mending_source.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/scripted_sample_source.hpp"

namespace swiftlet {
namespace {

std::vector<RangeSample> flight_with_a_leap() {
  std::vector<RangeSample> samples = flight_in_square_room(20, 2.0, 1.0);
  const Pose2 T_about = samples[10].T_odom_body;
  const Pose2 T_leap = T_about * Pose2(0.0, 0.0, radians(25.0)) * T_about.inverse();
  for (std::size_t i = 10; i < samples.size(); ++i) samples[i].T_odom_body = T_leap * samples[i].T_odom_body;
  return samples;
}

TEST(MotionMendingSource, DeliversWhatWasFlownAndSaysSo) {
  MotionMendingSource source(std::make_unique<ScriptedSampleSource>(flight_with_a_leap()));
  const std::vector<RangeSample> flown = flight_in_square_room(20, 2.0, 1.0);
  std::vector<std::string> events;
  for (const RangeSample& sample : flown) {
    const Result<ReceivedSample> received = source.next();
    ASSERT_TRUE(received);
    EXPECT_TRUE(poses_near(received->sample.T_odom_body, sample.T_odom_body, 0.01, 0.01));
    while (const auto event = source.take_event()) events.push_back(describe(*event));
  }
  EXPECT_THAT(events, testing::ElementsAre(testing::HasSubstr("leapt as no vehicle can turn, 1 times")));
  EXPECT_EQ(source.next().error().code, ErrorCode::kEndOfRecording);
  EXPECT_TRUE(source.report().notes.empty()) << "it has not ended";
  source.end();
  EXPECT_EQ(source.report().counters.samples, 20U);
  EXPECT_THAT(source.report().notes, testing::ElementsAre(testing::HasSubstr("leaps 1 times")));
}

TEST(MotionMendingSource, ARestartIsJoinedBeforeALeapBehindItIsTakenOut) {
  const std::vector<RangeSample> flown = flight_in_square_room(20, 2.0, 1.0);
  std::vector<RangeSample> reported = flight_with_a_leap();
  const Pose2 T_odom_new = reported[5].T_odom_body;
  reported[5].starts_segment = true;
  for (std::size_t i = 5; i < reported.size(); ++i)
    reported[i].T_odom_body = between(T_odom_new, reported[i].T_odom_body);
  MotionMendingSource source(std::make_unique<ScriptedSampleSource>(reported));
  std::vector<RangeSample> delivered;
  while (const Result<ReceivedSample> received = source.next()) delivered.push_back(received->sample);
  source.end();
  EXPECT_THAT(source.report().notes, testing::ElementsAre(testing::HasSubstr("restarted 1 times"),
                                                          testing::HasSubstr("leaps 1 times")));
  ASSERT_EQ(delivered.size(), flown.size());
  for (std::size_t i = 0; i < flown.size(); ++i) {
    EXPECT_TRUE(poses_near(delivered[i].T_odom_body, flown[i].T_odom_body, 0.02, 0.02)) << i;
    EXPECT_TRUE(poses_near(as_reported(source.mended(), reported[i].stamp, delivered[i].T_odom_body),
                           reported[i].T_odom_body, 1e-9, 1e-9))
        << i;
    EXPECT_EQ(delivered[i].starts_segment, i == 0) << i;
  }
}

/// As the firmware does with an estimate that has run away: position and heading are zero from one packet to
/// the next.
TEST(MotionMendingSource, AResetOfTheEstimatorIsJoinedAsItComesFromTheVehicle) {
  InputCounters counters;
  SampleAssembler assembler(flight_assembly(SensorModel::crazyflie()), counters);
  assembler.set_periods(std::chrono::milliseconds(100), std::chrono::milliseconds(100));
  QuickRestarts restarts;
  std::vector<RangeSample> samples;
  for (int i = 0; i < 60; ++i) {
    const int since_reset = i < 30 ? i : i - 30;
    Reading reading;
    reading.at = DeviceTime(i * std::chrono::milliseconds(100));
    reading.received = HostTime(i * std::chrono::milliseconds(100));
    reading.position_odom = Point2{0.04 * since_reset, 0.0};
    reading.yaw_odom_rad = 0.0;
    for (int beam = 0; beam < 4; ++beam)
      ASSERT_TRUE(reading.distance_m.try_push_back(static_cast<float>(1.0 + 0.01 * i)));
    assembler.add(reading);
    for (auto sample = assembler.take(); sample; sample = assembler.take()) {
      restarts.mend(*sample);
      samples.push_back(*sample);
    }
  }
  EXPECT_EQ(counters.leaps, 1U);
  EXPECT_EQ(restarts.count(), 1U);
  ASSERT_GT(samples.size(), 50U);
  for (const RangeSample& sample : samples) {
    EXPECT_EQ(sample.starts_segment, sample.sequence == 0) << sample.sequence;
    EXPECT_NEAR(sample.T_odom_body.x_m(), 0.4 * to_seconds(sample.measured_at.time_since_epoch()), 1e-6);
  }
}

TEST(MotionMendingSource, SignsMayBeMendedUponIt) {
  const std::vector<RangeSample> reported = flight_with_a_leap();
  SignMendingSource source(
      std::make_unique<MotionMendingSource>(std::make_unique<ScriptedSampleSource>(reported)));
  std::vector<RangeSample> delivered;
  while (const Result<ReceivedSample> received = source.next()) delivered.push_back(received->sample);
  source.end();
  EXPECT_THAT(source.report().notes, testing::ElementsAre(testing::HasSubstr("leaps 1 times")));
  ASSERT_EQ(delivered.size(), reported.size());
  for (std::size_t i = 0; i < reported.size(); ++i)
    EXPECT_TRUE(poses_near(as_reported(source.mended(), reported[i].stamp, delivered[i].T_odom_body),
                           reported[i].T_odom_body, 1e-9, 1e-9))
        << i;
}

TEST(MotionMendingSource, IsOnlyWhereItIsWanted) {
  const auto mended_of = [](bool mends_motion) {
    SampleSourceOptions options;
    options.mends_motion = mends_motion;
    Result<std::unique_ptr<SampleSource>> source =
        open_sample_source("sim://office?seed=1&fault=jump@5:20", options);
    if (!source) return std::size_t{0};
    int delivered = 0;  // between them the source waits for its vehicle
    for (int i = 0; i < 10000 && delivered < 100; ++i) delivered += (*source)->next() ? 1 : 0;
    EXPECT_EQ(delivered, 100);
    return (*source)->mended().size();
  };
  EXPECT_GE(mended_of(true), 1U);
  EXPECT_EQ(mended_of(false), 0U);
}

}  // namespace
}  // namespace swiftlet

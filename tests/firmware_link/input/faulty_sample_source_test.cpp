// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/input/faulty_sample_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "core/geometry/angle.hpp"
#include "tests/support/pose_near.hpp"

namespace swiftlet {
namespace {

constexpr double kPeriodS = 0.1;

/// A tenth of a metre along x ten times a second, for ten seconds.
class StraightFlight final : public SampleSource {
 public:
  [[nodiscard]] Result<ReceivedSample> next() override {
    if (number_ == 100) return Error{ErrorCode::kEndOfRecording, "the end"};
    ReceivedSample received;
    received.sample.sequence = number_;
    received.sample.measured_at = DeviceTime(from_seconds(kPeriodS * number_));
    received.sample.stamp = HostTime(from_seconds(kPeriodS * number_));
    received.sample.T_odom_body = Pose2(0.1 * number_, 0.0, 0.0);
    received.sample.starts_segment = number_ == 0;
    truth_.push_back({received.sample.stamp, received.sample.T_odom_body});
    report_.counters.samples = ++number_;
    report_.counters.segments = 1;
    return received;
  }
  [[nodiscard]] const BeamLayout& beams() const override { return beams_; }
  [[nodiscard]] const SensorModel& sensor() const override { return sensor_; }
  [[nodiscard]] const InputReport& report() const override { return report_; }
  [[nodiscard]] std::vector<StampedPose> ground_truth() const override { return truth_; }

 private:
  BeamLayout beams_ = BeamLayout::multiranger();
  SensorModel sensor_;
  InputReport report_;
  std::uint32_t number_ = 0;
  std::vector<StampedPose> truth_;
};

struct Broken {
  std::vector<RangeSample> samples;
  std::vector<StampedPose> truth;
};

Broken flown_with(const char* faults) {
  FaultySampleSource source(std::make_unique<StraightFlight>(), parse_motion_faults(faults).value());
  Broken flown;
  for (Result<ReceivedSample> next = source.next(); next; next = source.next())
    flown.samples.push_back(next->sample);
  flown.truth = source.ground_truth();
  return flown;
}

double at_s(const RangeSample& sample) { return to_seconds(sample.stamp.time_since_epoch()); }

TEST(FaultySampleSource, ASilenceLosesSamplesAndTheEstimateRunsOn) {
  const Broken flown = flown_with("silence@5:2");
  ASSERT_EQ(flown.samples.size(), 80U);
  const RangeSample& first = flown.samples[50];
  EXPECT_TRUE(first.starts_segment && first.odometry_ran_on);
  EXPECT_NEAR(at_s(first), 7.0, 1e-9);
  EXPECT_TRUE(poses_near(first.T_odom_body, Pose2(7.0, 0.0, 0.0), 1e-9, 1e-9));
  EXPECT_FALSE(flown.samples[51].starts_segment);
}

TEST(FaultySampleSource, ARestartBeginsTheEstimateAnewAndTakesItsTime) {
  const Broken flown = flown_with("restart@5:60");
  ASSERT_EQ(flown.samples.size(), 100U);
  const RangeSample& first = flown.samples[50];
  EXPECT_TRUE(first.starts_segment && !first.odometry_ran_on);
  EXPECT_NEAR(at_s(first), 65.0, 1e-9);
  EXPECT_TRUE(poses_near(first.T_odom_body, Pose2(), 1e-9, 1e-9));
  EXPECT_TRUE(poses_near(flown.samples[60].T_odom_body, Pose2(1.0, 0.0, 0.0), 1e-9, 1e-9));
  EXPECT_EQ(flown.truth[50].stamp, first.stamp);
  EXPECT_EQ(flown.truth[49].stamp, flown.samples[49].stamp);
}

TEST(FaultySampleSource, ACarriedVehicleRestartsElsewhere) {
  const Broken flown = flown_with("carried@5:3");
  ASSERT_EQ(flown.samples.size(), 70U);
  EXPECT_TRUE(flown.samples[50].starts_segment && !flown.samples[50].odometry_ran_on);
  EXPECT_TRUE(poses_near(flown.samples[50].T_odom_body, Pose2(), 1e-9, 1e-9));
}

TEST(FaultySampleSource, ATeleportTellsNothing) {
  const Broken flown = flown_with("teleport@5:3");
  ASSERT_EQ(flown.samples.size(), 70U);
  EXPECT_FALSE(flown.samples[50].starts_segment);
  EXPECT_NEAR(at_s(flown.samples[50]), 5.0, 1e-9);
  EXPECT_TRUE(poses_near(flown.samples[50].T_odom_body, Pose2(4.9, 0.0, 0.0), 1e-9, 1e-9));
}

TEST(FaultySampleSource, ItsReportCountsWhatTheFaultsLeft) {
  FaultySampleSource source(std::make_unique<StraightFlight>(),
                            parse_motion_faults("silence@0:1,restart@5:60,teleport@7:1").value());
  std::uint32_t samples = 0;
  for (Result<ReceivedSample> next = source.next(); next; next = source.next()) {
    EXPECT_EQ(next->sample.sequence, samples);
    EXPECT_EQ(source.report().counters.samples, ++samples);
  }
  const InputCounters& counters = source.report().counters;
  EXPECT_EQ(counters.samples, 80U);
  EXPECT_EQ(counters.segments, 2U);
  EXPECT_EQ(counters.gaps, 1U);  // a teleport is none
  EXPECT_EQ(counters.missing_packets, 10U);
}

TEST(FaultySampleSource, AFaultThatTheFlightDoesNotComeToIsANote) {
  FaultySampleSource source(std::make_unique<StraightFlight>(),
                            parse_motion_faults("reset@5,slip@9.8:20,jump@10.5:90,slip@3000:20").value());
  while (source.next()) continue;
  EXPECT_TRUE(source.report().notes.empty()) << "it has not ended";
  source.end();
  EXPECT_THAT(source.report().notes,
              testing::ElementsAre("the fault after 10.5 s never began: the flight ended before",
                                   "the fault after 3000 s never began: the flight ended before"));
}

TEST(FaultySampleSource, ASlipHidesTheWayAndAJumpTurnsIt) {
  const Broken flown = flown_with("slip@2:1,jump@4.93:90");
  ASSERT_EQ(flown.samples.size(), 100U);
  EXPECT_NEAR(flown.samples[29].T_odom_body.x_m(), 1.9, 1e-9);
  EXPECT_NEAR(flown.samples[49].T_odom_body.x_m(), 3.9, 0.11);
  EXPECT_NEAR(flown.samples[49].T_odom_body.yaw_rad(), 0.0, 1e-9);
  EXPECT_NEAR(flown.samples[50].T_odom_body.yaw_rad(), 0.7 * std::numbers::pi / 2.0, 1e-9)
      << "between readings";
  const Pose2 moved = between(flown.samples[51].T_odom_body, flown.samples[61].T_odom_body);
  EXPECT_TRUE(poses_near(moved, Pose2(1.0, 0.0, 0.0), 1e-9, 1e-9));
  EXPECT_NEAR(flown.samples[60].T_odom_body.yaw_rad(), std::numbers::pi / 2.0, 1e-9);
}

TEST(FaultySampleSource, ATurnIsAsSlowAsAVehicles) {
  const Broken flown = flown_with("turn@2:90,turn@6:-40");
  ASSERT_EQ(flown.samples.size(), 100U);
  for (std::size_t i = 1; i < flown.samples.size(); ++i) {
    const Pose2 step = between(flown.samples[i - 1].T_odom_body, flown.samples[i].T_odom_body);
    ASSERT_LT(std::abs(step.yaw_rad()), radians(4.6)) << i;
    ASSERT_NEAR(step.x_m(), 0.1, 1e-9) << i << ": along the heading that the estimate has";
  }
  EXPECT_NEAR(flown.samples[20].T_odom_body.yaw_rad(), 0.0, 1e-9);
  EXPECT_NEAR(flown.samples[30].T_odom_body.yaw_rad(), radians(45.0), 1e-9);
  EXPECT_NEAR(flown.samples[50].T_odom_body.yaw_rad(), radians(90.0), 1e-9);
  EXPECT_NEAR(flown.samples[99].T_odom_body.yaw_rad(), radians(50.0), 1e-9);
}

}  // namespace
}  // namespace swiftlet

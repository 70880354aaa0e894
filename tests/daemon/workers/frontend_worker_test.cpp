// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/frontend_worker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tests/support/manual_clock.hpp"
#include "tests/support/scripted_sample_source.hpp"

namespace swiftlet {
namespace {

/// A frontend worker between queues that the test fills and empties.
struct FrontendBench {
  FrontendBench()
      : worker(frontend, clock, queues->samples.consumer(), queues->steps.producer(), queues->correction,
               queues->to_publisher.frontend_outlet(),
               BeamReadings::of(BeamLayout::multiranger(), SensorModel::crazyflie()), times) {}

  void push(const RangeSample& sample, MonotonicTime arrived_at = {}) {
    ASSERT_TRUE(queues->samples.producer().try_push({sample, arrived_at}));
  }
  PoseUpdate pop_pose() {
    PoseUpdate pose;
    EXPECT_TRUE(queues->to_publisher.poses.consumer().try_pop(pose));
    return pose;
  }

  ManualClock clock;
  Frontend frontend{FrontendConfig{}, SensorModel::crazyflie(), BeamLayout::multiranger()};
  std::unique_ptr<PipelineQueues> queues = std::make_unique<PipelineQueues>();
  StageHistogram times;
  FrontendWorker worker;
};

TEST(FrontendWorker, IsIdleUntilASampleComesAndFinishedAfterTheLast) {
  FrontendBench bench;
  EXPECT_EQ(bench.worker.step(), StepResult::kIdle);
  bench.push(resting_samples(1).front());
  bench.queues->samples.producer().close();
  EXPECT_EQ(bench.worker.step(), StepResult::kProgress);
  EXPECT_FALSE(bench.queues->steps.consumer().closed());
  EXPECT_EQ(bench.worker.step(), StepResult::kFinished);
  EXPECT_TRUE(bench.queues->steps.consumer().closed());
}

TEST(FrontendWorker, HandsItsAnswerToTheBackend) {
  FrontendBench bench;
  bench.push(flight_in_square_room(1, 3.0, 1.0).front());
  ASSERT_EQ(bench.worker.step(), StepResult::kProgress);
  FrontendStep step;
  ASSERT_TRUE(bench.queues->steps.consumer().try_pop(step));
  EXPECT_EQ(step.sample.sequence, 0U);
  EXPECT_TRUE(step.has_keyframe) << "the first sample is the first keyframe";
}

TEST(FrontendWorker, WaitsForRoomSoThatNoKeyframeIsEverMissing) {
  FrontendBench bench;
  const auto filler = std::make_unique<FrontendStep>();
  while (bench.queues->steps.producer().has_room())
    ASSERT_TRUE(bench.queues->steps.producer().try_push(*filler));
  bench.push(resting_samples(1).front());
  EXPECT_EQ(bench.worker.step(), StepResult::kBlocked);
  EXPECT_EQ(bench.frontend.counters().samples, 0U);
  ASSERT_TRUE(bench.queues->steps.consumer().try_pop(*filler));
  EXPECT_EQ(bench.worker.step(), StepResult::kProgress);
  EXPECT_EQ(bench.queues->steps.rejected_count(), 0U);
}

TEST(FrontendWorker, ThePoseKnowsWhenItsSampleArrived) {
  FrontendBench bench;
  bench.push(resting_samples(1).front(), MonotonicTime(std::chrono::seconds(7)));
  ASSERT_EQ(bench.worker.step(), StepResult::kProgress);
  EXPECT_EQ(bench.pop_pose().arrived_at, MonotonicTime(std::chrono::seconds(7)));
}

TEST(FrontendWorker, ThePoseCarriesTheBeamsThatWereMeasuredThere) {
  FrontendBench bench;
  RangeSample sample = flight_in_square_room(1, 3.0, 1.0).front();
  sample.measured_at = DeviceTime(std::chrono::seconds(9));
  sample.status[2] = RangeStatus::kNoReturn;
  bench.push(sample);
  ASSERT_EQ(bench.worker.step(), StepResult::kProgress);
  const PoseUpdate pose = bench.pop_pose();
  EXPECT_EQ(pose.measured_at, sample.measured_at);
  EXPECT_EQ(pose.beams.count, 4);
  EXPECT_EQ(pose.beams.max_range_m, 3.0F);
  EXPECT_EQ(pose.beams.bearing_rad[3], static_cast<float>(-kPi / 2.0));
  EXPECT_EQ(pose.beams.distance_m, sample.distance_m);
  EXPECT_EQ(pose.beams.status, sample.status);
}

TEST(FrontendWorker, AppliesTheNewestCorrectionToThePoseItPublishes) {
  FrontendBench bench;
  const std::vector<RangeSample> flight = flight_in_square_room(2, 3.0, 1.0);
  bench.push(flight[0]);
  static_cast<void>(bench.worker.step());
  const PoseUpdate before = bench.pop_pose();
  EXPECT_EQ(before.correction_version, 0U);
  EXPECT_DOUBLE_EQ(before.T_map_body.x_m(), before.T_local_body.x_m());

  bench.queues->correction.store({.keyframe = {}, .T_map_local = Pose2(9.0, 0.0, 0.0), .version = 1});
  bench.queues->correction.store({.keyframe = {}, .T_map_local = Pose2(10.0, 0.0, 0.0), .version = 2});
  bench.push(flight[1]);
  static_cast<void>(bench.worker.step());
  const PoseUpdate after = bench.pop_pose();
  EXPECT_EQ(after.correction_version, 2U);
  EXPECT_DOUBLE_EQ(after.correction_m, 10.0);
  EXPECT_DOUBLE_EQ(after.T_map_body.x_m(), after.T_local_body.x_m() + 10.0);
  EXPECT_DOUBLE_EQ(after.T_odom_body.x_m(), flight[1].T_odom_body.x_m());

  const auto handed_on = std::make_unique<FrontendStep>();
  for (const PoseUpdate& published : {before, after}) {
    ASSERT_TRUE(bench.queues->steps.consumer().try_pop(*handed_on));
    EXPECT_DOUBLE_EQ(handed_on->T_map_body.x_m(), published.T_map_body.x_m());
  }
}

TEST(FrontendWorker, CarriesTheNewestConfidenceOnToThePoseItPublishes) {
  FrontendBench bench;
  const std::vector<RangeSample> flight = flight_in_square_room(2, 3.0, 1.0);
  bench.push(flight[0]);
  static_cast<void>(bench.worker.step());
  EXPECT_EQ(bench.pop_pose().from_start.xx, 0.0) << "the backend has said nothing yet";

  PoseConfidence confidence;
  confidence.from_start = {.xx = 0.5, .yy = 0.25, .yaw_yaw = 0.01};
  confidence.figures.tracking = Tracking::kUncertain;
  bench.queues->to_publisher.confidence.store(confidence);
  bench.push(flight[1]);
  static_cast<void>(bench.worker.step());
  const PoseUpdate pose = bench.pop_pose();
  EXPECT_EQ(pose.tracking, Tracking::kUncertain);
  EXPECT_DOUBLE_EQ(pose.from_start.xx, carried_on(confidence.from_start, confidence, pose.T_local_body).xx);
  EXPECT_GE(pose.from_start.xx, 0.5);
}

/// What it publishes of each sample, the backend having seen none since that of the confidence.
std::vector<Tracking> tracking_of(FrontendBench& bench, std::span<const RangeSample> samples) {
  std::vector<Tracking> published;
  for (const RangeSample& sample : samples) {
    bench.push(sample);
    EXPECT_EQ(bench.worker.step(), StepResult::kProgress);
    published.push_back(bench.pop_pose().tracking);
  }
  return published;
}

TEST(FrontendWorker, BehindARestartThePoseIsLostUntilTheBackendHasSeenIt) {
  using enum Tracking;
  FrontendBench bench;
  std::vector<RangeSample> samples = resting_samples(5);
  samples[1].starts_segment = samples[3].starts_segment = true;
  PoseConfidence confidence;
  confidence.has_older_map = true;
  bench.queues->to_publisher.confidence.store(confidence);
  EXPECT_THAT(tracking_of(bench, samples), testing::ElementsAre(kTracking, kLost, kLost, kLost, kLost));
  const std::span<const RangeSample> next = std::span(samples).last(1);
  confidence.figures.tracking = kRelocalizing;
  for (const auto& [keyframe, expected] : {std::pair{1U, kLost}, {2U, kRelocalizing}}) {
    confidence.keyframe = KeyframeId{keyframe};  // of the first restart, then of the second
    bench.queues->to_publisher.confidence.store(confidence);
    EXPECT_THAT(tracking_of(bench, next), testing::ElementsAre(expected));
  }
}

TEST(FrontendWorker, WhereNoPlaceIsLostTheStateIsTheBackends) {
  FrontendBench bench;
  std::vector<RangeSample> samples = resting_samples(3);
  samples[1].starts_segment = true;
  EXPECT_THAT(tracking_of(bench, samples), testing::Each(Tracking::kTracking)) << "no older map";
  samples[0].starts_segment = samples[0].odometry_ran_on = samples[1].odometry_ran_on = true;
  PoseConfidence confidence;
  confidence.keyframe = KeyframeId{1};
  confidence.has_older_map = true;
  bench.queues->to_publisher.confidence.store(confidence);
  EXPECT_THAT(tracking_of(bench, samples), testing::Each(Tracking::kTracking)) << "it ran on";
}

TEST(FrontendWorker, CountsHowOftenTheDeadReckoningBeganAnew) {
  FrontendBench bench;
  std::vector<RangeSample> samples = resting_samples(3);
  samples[2].starts_segment = true;
  for (const RangeSample& sample : samples) {
    bench.push(sample);
    static_cast<void>(bench.worker.step());
  }
  EXPECT_EQ(bench.pop_pose().segment, 1U);
  EXPECT_EQ(bench.pop_pose().segment, 1U);
  EXPECT_EQ(bench.pop_pose().segment, 2U);
}

TEST(FrontendWorker, GoesOnWhenThePublisherTakesNoPoses) {
  FrontendBench bench;
  const std::vector<RangeSample> samples = resting_samples(PoseQueue::capacity() + 1);
  const auto handed_on = std::make_unique<FrontendStep>();
  for (const RangeSample& sample : samples) {
    bench.push(sample);
    ASSERT_EQ(bench.worker.step(), StepResult::kProgress);
    ASSERT_TRUE(bench.queues->steps.consumer().try_pop(*handed_on));
  }
  EXPECT_EQ(bench.queues->to_publisher.poses.rejected_count(), 1U);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/radio_worker.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/manual_clock.hpp"
#include "tests/support/scripted_sample_source.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

/// A radio worker in front of a queue that the test empties.
struct RadioBench {
  explicit RadioBench(std::vector<RangeSample> samples, const InputPolicy& policy = {},
                      Error end = {ErrorCode::kEndOfRecording, ""})
      : source(std::move(samples), std::move(end)),
        worker(source, clock, policy, queue->producer(), InputOutlet{status, events->producer()}, times) {}

  std::optional<RangeSample> pop() {
    ReceivedSample received;
    if (!queue->consumer().try_pop(received)) return std::nullopt;
    arrived_at = received.arrived_at;
    return received.sample;
  }
  InputStatus newest_status() {
    InputStatus newest;
    static_cast<void>(status.load_if_new(newest));
    return newest;
  }

  ManualClock clock;
  MonotonicTime arrived_at{};  // of the last sample popped
  ScriptedSampleSource source;
  std::unique_ptr<SampleQueue> queue = std::make_unique<SampleQueue>();
  LatestValue<InputStatus> status;
  std::unique_ptr<EventQueue> events = std::make_unique<EventQueue>();
  StageHistogram times;
  RadioWorker worker;
};

TEST(RadioWorker, HandsOnEachSampleAndClosesTheQueueAtTheEnd) {
  RadioBench bench(resting_samples(2));
  EXPECT_EQ(bench.worker.step(), StepResult::kProgress);
  EXPECT_EQ(bench.worker.step(), StepResult::kProgress);
  EXPECT_FALSE(bench.queue->consumer().closed());
  EXPECT_EQ(bench.worker.step(), StepResult::kFinished);
  EXPECT_EQ(bench.worker.step(), StepResult::kFinished);
  EXPECT_TRUE(bench.queue->consumer().closed());
  EXPECT_EQ(bench.pop()->sequence, 0U);
  EXPECT_EQ(bench.pop()->sequence, 1U);
  EXPECT_FALSE(bench.pop());
  EXPECT_TRUE(bench.worker.outcome());
  EXPECT_TRUE(bench.newest_status().ended);
}

TEST(RadioWorker, HoldsASampleBackUntilItIsDue) {
  RadioBench bench(resting_samples(2), {.rate = 10.0});
  EXPECT_EQ(bench.worker.step(), StepResult::kProgress);
  EXPECT_EQ(bench.worker.step(), StepResult::kIdle);
  EXPECT_EQ(bench.worker.due(), bench.clock.now() + milliseconds(10));
  bench.clock.advance(milliseconds(9));
  EXPECT_EQ(bench.worker.step(), StepResult::kIdle);
  bench.clock.advance(milliseconds(1));
  EXPECT_EQ(bench.worker.step(), StepResult::kProgress);
}

TEST(RadioWorker, ARecordedSampleArrivesWhenItIsDue) {
  RadioBench bench(resting_samples(2), {.rate = 10.0});
  EXPECT_EQ(bench.worker.step(), StepResult::kProgress);
  EXPECT_EQ(bench.worker.step(), StepResult::kIdle);
  bench.clock.advance(milliseconds(10));
  EXPECT_EQ(bench.worker.step(), StepResult::kProgress);
  ASSERT_TRUE(bench.pop());
  EXPECT_EQ(bench.arrived_at, MonotonicTime{});
  ASSERT_TRUE(bench.pop());
  EXPECT_EQ(bench.arrived_at, MonotonicTime(milliseconds(10)));
}

TEST(RadioWorker, ALiveSampleArrivesWithItsFrame) {
  RadioBench bench(resting_samples(1));
  bench.source.arrived_at = MonotonicTime(milliseconds(47));
  bench.clock.advance(milliseconds(50));
  EXPECT_EQ(bench.worker.step(), StepResult::kProgress);
  ASSERT_TRUE(bench.pop());
  EXPECT_EQ(bench.arrived_at, MonotonicTime(milliseconds(47)));
}

TEST(RadioWorker, ARecordingWaitsWhileTheQueueIsFull) {
  RadioBench bench(resting_samples(SampleQueue::capacity() + 1));
  for (std::size_t i = 0; i < SampleQueue::capacity(); ++i)
    ASSERT_EQ(bench.worker.step(), StepResult::kProgress);
  EXPECT_EQ(bench.worker.step(), StepResult::kBlocked);
  ASSERT_TRUE(bench.pop());
  EXPECT_EQ(bench.worker.step(), StepResult::kProgress);
  EXPECT_EQ(bench.queue->rejected_count(), 0U);
}

TEST(RadioWorker, ALiveLinkRefusesTheNewestWhileTheQueueIsFull) {
  RadioBench bench(resting_samples(SampleQueue::capacity() + 3), {.refuses_when_full = true});
  for (std::size_t i = 0; i < SampleQueue::capacity() + 2; ++i)
    ASSERT_EQ(bench.worker.step(), StepResult::kProgress);
  EXPECT_EQ(bench.queue->rejected_count(), 2U);
  for (std::size_t i = 0; i < SampleQueue::capacity(); ++i) ASSERT_EQ(bench.pop()->sequence, i);
  ASSERT_EQ(bench.worker.step(), StepResult::kProgress);
  EXPECT_EQ(bench.pop()->sequence, SampleQueue::capacity() + 2);
}

TEST(RadioWorker, AfterARefusedBreakTheDeadReckoningHasNotRunOn) {
  std::vector<RangeSample> samples = resting_samples(SampleQueue::capacity() + 2);
  samples[SampleQueue::capacity()].starts_segment = true;  // will be refused
  samples[SampleQueue::capacity() + 1].starts_segment = true;
  samples[SampleQueue::capacity() + 1].odometry_ran_on = true;
  RadioBench bench(std::move(samples), {.refuses_when_full = true});
  for (std::size_t i = 0; i < SampleQueue::capacity() + 1; ++i) static_cast<void>(bench.worker.step());
  while (bench.pop()) {
  }
  static_cast<void>(bench.worker.step());
  const std::optional<RangeSample> after = bench.pop();
  ASSERT_TRUE(after);
  EXPECT_TRUE(after->starts_segment);
  EXPECT_FALSE(after->odometry_ran_on);
}

TEST(RadioWorker, ABreakInTheDeadReckoningOutlivesTheRefusedSampleThatBeganIt) {
  std::vector<RangeSample> samples = resting_samples(SampleQueue::capacity() + 4);
  samples[SampleQueue::capacity()].starts_segment = true;  // will be refused, as the one after it
  RadioBench bench(std::move(samples), {.refuses_when_full = true});
  for (std::size_t i = 0; i < SampleQueue::capacity() + 2; ++i) static_cast<void>(bench.worker.step());
  while (bench.pop()) {
  }
  static_cast<void>(bench.worker.step());
  static_cast<void>(bench.worker.step());
  EXPECT_TRUE(bench.pop()->starts_segment);
  EXPECT_FALSE(bench.pop()->starts_segment);
}

TEST(RadioWorker, KeepsWhatEndedTheInputBeforeItsTime) {
  RadioBench bench(resting_samples(1), {}, {ErrorCode::kNotFound, "the dongle is gone"});
  static_cast<void>(bench.worker.step());
  EXPECT_EQ(bench.worker.step(), StepResult::kFinished);
  ASSERT_FALSE(bench.worker.outcome());
  EXPECT_EQ(bench.worker.outcome().error().message, "the dongle is gone");
  EXPECT_TRUE(bench.queue->consumer().closed());
}

TEST(RadioWorker, GoesOnListeningToASilentLink) {
  RadioBench bench(resting_samples(1), {}, {ErrorCode::kTimeout, ""});
  static_cast<void>(bench.worker.step());
  EXPECT_EQ(bench.worker.step(), StepResult::kIdle);
  EXPECT_EQ(bench.worker.step(), StepResult::kIdle);
  EXPECT_FALSE(bench.queue->consumer().closed());
}

TEST(RadioWorker, SaysHowTheLinkStandsAlsoWhileNothingIsHeard) {
  RadioBench bench({}, {}, {ErrorCode::kTimeout, ""});
  EXPECT_FALSE(bench.worker.has_client());
  bench.source.live.link.condition = LinkCondition::kSilent;
  bench.source.live.sharing.has_client = true;
  bench.source.event = VehicleEvent{VehicleEvent::Kind::kDataStopped, 0};
  EXPECT_EQ(bench.worker.step(), StepResult::kIdle);
  EXPECT_EQ(bench.newest_status().live.link.condition, LinkCondition::kSilent);
  EXPECT_TRUE(bench.worker.has_client());
  VehicleEvent event;
  ASSERT_TRUE(bench.events->consumer().try_pop(event));
  EXPECT_EQ(event.kind, VehicleEvent::Kind::kDataStopped);
  EXPECT_FALSE(bench.events->consumer().try_pop(event));
}

TEST(RadioWorker, EndsTheInputWhenTold) {
  RadioBench bench(resting_samples(5));
  static_cast<void>(bench.worker.step());
  bench.worker.end_input();
  EXPECT_EQ(bench.worker.step(), StepResult::kFinished);
  EXPECT_TRUE(bench.queue->consumer().closed());
  EXPECT_EQ(bench.newest_status().counters.samples, 1U);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/backend_worker.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/manual_clock.hpp"
#include "tests/support/scripted_sample_source.hpp"

namespace swiftlet {
namespace {

/// A backend worker behind a queue that the test fills from a frontend.
struct BackendBench {
  BackendBench()
      : worker({}, backend, map, clock, queues->steps.consumer(), queues->correction,
               queues->to_publisher.backend_outlet(), times) {}

  void push(const RangeSample& sample) {
    ASSERT_TRUE(queues->steps.producer().try_push(frontend.process(sample)));
  }
  std::optional<MapTile> pop_tile() {
    MapTile tile;
    if (!queues->to_publisher.tiles.consumer().try_pop(tile)) return std::nullopt;
    return tile;
  }

  ManualClock clock;
  SensorModel sensor = SensorModel::crazyflie();
  Frontend frontend{FrontendConfig{}, sensor, BeamLayout::multiranger()};
  Backend backend{BackendConfig{}, sensor, BeamLayout::multiranger()};
  MapBuilder map{MapConfig{}, sensor};
  std::unique_ptr<PipelineQueues> queues = std::make_unique<PipelineQueues>();
  StageTimes times;
  BackendWorker worker;
};

TEST(BackendWorker, IsIdleWhileNothingComes) {
  BackendBench bench;
  EXPECT_EQ(bench.worker.step(), StepResult::kIdle);
}

TEST(BackendWorker, ExecutesCommandsBetweenStepsAndWhileNothingComes) {
  BackendBench bench;
  std::vector<std::optional<HostTime>> executed_at;
  bench.worker.execute_commands_by(bench.queues->commands.consumer(),
                                   [&](const Command&, const MapBuilder&, std::optional<HostTime> newest) {
                                     executed_at.push_back(newest);
                                   });
  ASSERT_TRUE(bench.queues->commands.producer().try_push({}));
  bench.worker.wait();  // does not sleep
  EXPECT_EQ(bench.worker.step(), StepResult::kIdle);
  ASSERT_EQ(executed_at.size(), 1U);
  EXPECT_FALSE(executed_at[0]);
  const std::vector<RangeSample> samples = flight_in_square_room(1, 2.0, 1.0);
  bench.push(samples[0]);
  EXPECT_EQ(bench.worker.step(), StepResult::kProgress);
  ASSERT_TRUE(bench.queues->commands.producer().try_push({}));
  EXPECT_EQ(bench.worker.step(), StepResult::kIdle);
  ASSERT_EQ(executed_at.size(), 2U);
  EXPECT_EQ(executed_at[1], samples[0].stamp);
}

TEST(BackendWorker, ACommandThatComesBehindItsLastStepIsNotForgotten) {
  BackendBench bench;
  int executed = 0;
  bench.worker.execute_commands_by(
      bench.queues->commands.consumer(),
      [&](const Command&, const MapBuilder&, std::optional<HostTime>) { ++executed; });
  bench.queues->steps.producer().close();
  ASSERT_EQ(bench.worker.step(), StepResult::kFinished);
  ASSERT_TRUE(bench.queues->commands.producer().try_push({}));
  bench.worker.execute_commands();
  EXPECT_EQ(executed, 1);
}

TEST(BackendWorker, DrawsAtKeyframesAndHandsOnTheTiles) {
  BackendBench bench;
  for (const RangeSample& sample : flight_in_square_room(30, 2.0, 1.0)) {
    bench.push(sample);
    ASSERT_EQ(bench.worker.step(), StepResult::kProgress);
  }
  EXPECT_TRUE(bench.pop_tile());
  EXPECT_EQ(bench.backend.counters().scans, 30U);
  const StageSummary drawn = bench.times.map.summary("map");
  EXPECT_EQ(drawn.count, bench.frontend.counters().keyframes);
}

TEST(BackendWorker, RunsTheFinalPassOnceAndFinishesWhenAllIsHandedOn) {
  BackendBench bench;
  for (const RangeSample& sample : flight_in_square_room(30, 2.0, 1.0)) bench.push(sample);
  bench.queues->steps.producer().close();
  StepResult result = StepResult::kProgress;
  for (int i = 0; i < 30; ++i) ASSERT_EQ(bench.worker.step(), StepResult::kProgress);
  result = bench.worker.step();
  EXPECT_EQ(result, StepResult::kFinished);
  EXPECT_TRUE(bench.queues->to_publisher.tiles.consumer().closed());
  EXPECT_EQ(bench.worker.step(), StepResult::kFinished);

  std::map<TileIndex, MapTile> received;
  while (const std::optional<MapTile> tile = bench.pop_tile()) received.insert_or_assign(tile->index, *tile);
  ASSERT_EQ(received.size(), bench.map.tiles().size());
  for (const auto& [index, tile] : received)
    EXPECT_EQ(tile.occupancy_percent, bench.map.tile(index).occupancy_percent);
}

TEST(BackendWorker, WithoutAPublisherDrawsTheSameMapOnceAtTheEnd) {
  BackendBench published;
  BackendBench unpublished;
  BackendWorker alone({}, unpublished.backend, unpublished.map, unpublished.clock,
                      unpublished.queues->steps.consumer(), unpublished.queues->correction, std::nullopt,
                      unpublished.times);
  for (const RangeSample& sample : flight_in_square_room(30, 2.0, 1.0)) {
    published.push(sample);
    unpublished.push(sample);
    ASSERT_EQ(published.worker.step(), StepResult::kProgress);
    ASSERT_EQ(alone.step(), StepResult::kProgress);
    EXPECT_TRUE(unpublished.map.tiles().empty());
  }
  published.queues->steps.producer().close();
  unpublished.queues->steps.producer().close();
  EXPECT_EQ(published.worker.step(), StepResult::kFinished);
  EXPECT_EQ(alone.step(), StepResult::kFinished);
  EXPECT_EQ(unpublished.times.map.summary("map").count, 1U);
  ASSERT_EQ(unpublished.map.tiles(), published.map.tiles());
  for (const TileIndex index : published.map.tiles())
    EXPECT_EQ(unpublished.map.tile(index).occupancy_percent, published.map.tile(index).occupancy_percent);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/publish/publisher_worker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "tests/support/manual_clock.hpp"
#include "tests/support/recording_publisher.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

PublishConfig quick_refresh() {
  PublishConfig config;
  config.tile_refresh_period_s = 2.0;
  return config;
}

/// A publisher worker whose queues the test fills.
struct Bench {
  Bench()
      : worker(quick_refresh(), 0.05, queues->to_publisher.inlet(),
               {.queues = [this] { return queues->statistics(); },
                .stages = [] { return std::vector<StageSummary>{{.name = "map", .count = 3}}; },
                .pose_latency = latency,
                .recording =
                    [] {
                      return RecordingFigures{RecordingState::kRunning, 1000};
                    }},
               published, clock) {}

  void push_tile(std::int32_t x, std::uint32_t version, std::int8_t occupancy_percent = 80) {
    MapTile tile{.index = {x, -x}, .version = version};
    tile.occupancy_percent.fill(occupancy_percent);
    ASSERT_TRUE(queues->to_publisher.tiles.producer().try_push(tile));
  }
  StepResult tick() {
    clock.advance(PublisherWorker::kTick);
    return worker.step();
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) static_cast<void>(tick());
  }

  ManualClock clock;
  RecordingPublisher published;
  PoseLatency latency{milliseconds(2)};
  std::unique_ptr<PipelineQueues> queues = std::make_unique<PipelineQueues>();
  PublisherWorker worker;
};

TEST(PublisherWorker, PublishesEveryPoseAtItsNextTick) {
  Bench bench;
  auto poses = bench.queues->to_publisher.poses.producer();
  for (std::uint32_t i = 0; i < 5; ++i)
    ASSERT_TRUE(poses.try_push({.stamp = HostTime(milliseconds(i)), .sequence = i}));
  bench.ticks(1);
  ASSERT_EQ(bench.published.poses.size(), 5U);
  EXPECT_EQ(bench.published.poses[4].sequence, 4U);
}

TEST(PublisherWorker, PublishesTheEventsThatAPilotShouldActOn) {
  Bench bench;
  auto events = bench.queues->to_publisher.events.producer();
  using enum VehicleEvent::Kind;
  for (const VehicleEvent::Kind kind : {kConnected, kRangesFrozen, kClientGone, kRebooted})
    ASSERT_TRUE(events.try_push({kind, 0}));
  bench.ticks(1);
  EXPECT_THAT(bench.published.events, testing::ElementsAre(kRangesFrozen, kRebooted));
}

TEST(PublisherWorker, MeasuresEachPoseAgainstTheDeadlineOnceItIsSent) {
  Bench bench;
  auto poses = bench.queues->to_publisher.poses.producer();
  bench.published.on_pose = [&bench] { bench.clock.advance(milliseconds(1)); };
  ASSERT_TRUE(poses.try_push({.arrived_at = bench.clock.now()}));
  bench.worker.publish_poses();
  EXPECT_DOUBLE_EQ(bench.latency.times().summary("").max_ms, 1.0);
  EXPECT_EQ(bench.latency.missed(), 0U) << "1 ms of 2";
  ASSERT_TRUE(poses.try_push({.arrived_at = bench.clock.now() - milliseconds(2)}));
  bench.worker.publish_poses();
  EXPECT_EQ(bench.latency.missed(), 1U);
  bench.ticks(251);
  EXPECT_EQ(bench.published.statuses.back().missed_deadlines, 1U);
  EXPECT_EQ(bench.published.statuses.back().recording.state, RecordingState::kRunning);
  EXPECT_EQ(bench.published.statuses.back().recording.bytes, 1000U);
}

TEST(PublisherWorker, SendsChangedTilesAtOnceButNeverMoreThanTheReceiversBufferHolds) {
  Bench bench;
  for (std::int32_t x = 0; x < 10; ++x) bench.push_tile(x, 1);
  bench.ticks(1);
  EXPECT_EQ(bench.published.tiles.size(), PublisherWorker::kTilesPerStep);
  bench.ticks(2);
  EXPECT_EQ(bench.published.tiles.size(), 10U);
  EXPECT_EQ(bench.published.newest.size(), 10U);
}

TEST(PublisherWorker, SendsEveryTileAgainWithinTheRefreshPeriod) {
  Bench bench;
  for (std::int32_t x = 0; x < 7; ++x) bench.push_tile(x, 1);
  bench.ticks(2);
  bench.published.tiles.clear();
  bench.published.newest.clear();
  bench.ticks(static_cast<int>(milliseconds(2000) / PublisherWorker::kTick) + 1);
  EXPECT_EQ(bench.published.newest.size(), 7U);
  EXPECT_EQ(bench.published.tiles.size(), 7U) << "once each";
}

TEST(PublisherWorker, SaysHowItIsGoingOnceAPeriodWithMapAndWalls) {
  Bench bench;
  ASSERT_TRUE(
      bench.queues->to_publisher.walls.producer().try_push({.id = LandmarkId{2}, .start_map = {1.0, 2.0}}));
  ASSERT_TRUE(bench.queues->to_publisher.walls.producer().try_push({.id = LandmarkId{1}}));
  bench.queues->to_publisher.input.store({.counters = {.samples = 17}});
  bench.ticks(1);
  ASSERT_EQ(bench.published.statuses.size(), 1U) << "one at the start";
  bench.ticks(250);
  ASSERT_EQ(bench.published.statuses.size(), 2U);
  EXPECT_EQ(bench.published.maps.size(), 2U);
  ASSERT_EQ(bench.published.walls.size(), 2U);
  EXPECT_EQ(bench.published.walls[0].id, LandmarkId{1}) << "in the order of ids";
  const DaemonStatus& status = bench.published.statuses.back();
  EXPECT_EQ(status.state, DaemonState::kRunning);
  EXPECT_EQ(status.input.counters.samples, 17U);
  EXPECT_EQ(status.queues[4].high_water, 2U);
  ASSERT_EQ(status.stages.size(), 1U);
  EXPECT_EQ(status.stages[0].count, 3U);
}

TEST(PublisherWorker, ForgetsAWallThatIsGone) {
  Bench bench;
  auto walls = bench.queues->to_publisher.walls.producer();
  ASSERT_TRUE(walls.try_push({.id = LandmarkId{1}}));
  ASSERT_TRUE(walls.try_push({.id = LandmarkId{2}}));
  ASSERT_TRUE(walls.try_push({.id = LandmarkId{1}, .is_gone = true}));
  bench.ticks(1);
  ASSERT_EQ(bench.published.walls.size(), 1U);
  EXPECT_EQ(bench.published.walls[0].id, LandmarkId{2});
}

TEST(PublisherWorker, MakesRatesOfTheLinksCounts) {
  Bench bench;
  InputStatus input;
  input.live.link.packets_sent = 1000;
  bench.queues->to_publisher.input.store(input);
  bench.ticks(1);
  input.live.link.packets_sent = 1200;
  input.live.link.packets_acked = 150;
  input.live.link.radio_retries = 100;
  input.live.link.packets_received = 11;
  bench.queues->to_publisher.input.store(input);
  bench.ticks(250);
  ASSERT_EQ(bench.published.statuses.size(), 2U);
  const LinkRates& rates = bench.published.statuses.back().link_rates;
  EXPECT_DOUBLE_EQ(rates.ack_rate, 0.75);
  EXPECT_DOUBLE_EQ(rates.retries_per_packet, 0.5);
  EXPECT_NEAR(rates.sent_hz, 200.0, 2.0);
  EXPECT_NEAR(rates.received_hz, 11.0, 0.2);
}

TEST(PublisherWorker, MeasuresTheRateByTheMachinesClock) {
  Bench bench;
  bench.ticks(1);
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(bench.queues->to_publisher.poses.producer().try_push({}));
    bench.ticks(5);
  }
  EXPECT_NEAR(bench.published.statuses.back().sample_rate_hz, 50.0, 0.5);
}

TEST(PublisherWorker, SumsTheNewestVersionsSoThatAConsumerKnowsWhetherItHasThemAll) {
  Bench bench;
  bench.push_tile(-1, 1);
  bench.push_tile(3, 1);
  bench.push_tile(3, 5);
  bench.ticks(251);
  const MapSummary& map = bench.published.maps.back();
  EXPECT_EQ(map.tiles, 2U);
  EXPECT_EQ(map.version_sum, 6U);
  EXPECT_EQ(map.lowest, (TileIndex{-1, -3}));
  EXPECT_EQ(map.highest, (TileIndex{3, 1}));
}

TEST(PublisherWorker, SendsATileThatWasRubbedOutButLeavesItOutOfTheMapsExtent) {
  Bench bench;
  bench.push_tile(1, 1);
  bench.push_tile(9, 1);
  bench.push_tile(9, 2, -1);
  bench.ticks(251);
  EXPECT_EQ(bench.published.newest.at({9, -9}).version, 2U);
  EXPECT_EQ(bench.published.maps.back().tiles, 2U);
  EXPECT_EQ(bench.published.maps.back().highest, (TileIndex{1, -1}));
}

TEST(PublisherWorker, SaysThatItIsFinishingWhenTheInputHasEnded) {
  Bench bench;
  bench.queues->to_publisher.input.store({.counters = {}, .ended = true});
  bench.ticks(1);
  EXPECT_EQ(bench.published.statuses.back().state, DaemonState::kFinishing);
}

TEST(PublisherWorker, AtTheEndSendsEveryTileOnceMoreAndThenSaysFinished) {
  Bench bench;
  for (std::int32_t x = 0; x < 9; ++x) bench.push_tile(x, 1);
  bench.queues->to_publisher.tiles.producer().close();
  ASSERT_TRUE(bench.queues->to_publisher.poses.producer().try_push({.sequence = 1}));
  int steps = 0;
  while (bench.tick() != StepResult::kFinished) ASSERT_LT(++steps, 100);
  EXPECT_EQ(bench.published.poses.size(), 1U);
  EXPECT_EQ(bench.published.tiles.size(), 18U);
  ASSERT_GE(bench.published.statuses.size(), 3U);
  for (std::size_t i = bench.published.statuses.size() - 3; i < bench.published.statuses.size(); ++i) {
    EXPECT_EQ(bench.published.statuses[i].state, DaemonState::kFinished);
    EXPECT_EQ(bench.published.statuses[i].map.tiles, 9U);
  }
  EXPECT_EQ(bench.tick(), StepResult::kFinished) << "stays so";
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/workers/map_feed.hpp"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>

#include "core/frontend/frontend.hpp"
#include "tests/support/forgetful_run.hpp"
#include "tests/support/scripted_sample_source.hpp"

namespace swiftlet {
namespace {

constexpr std::uint32_t kSamples = 600;

/// A backend and a map that know a flight around a square room, and the publisher's queues.
struct MapFeedBench {
  explicit MapFeedBench(double resolution_m)
      : map(
            [resolution_m] {
              MapConfig config;
              config.resolution_m = resolution_m;
              return config;
            }(),
            sensor) {
    Frontend frontend(FrontendConfig{}, sensor, BeamLayout::multiranger());
    for (const RangeSample& sample : flight_in_square_room(kSamples, 6.0, 4.5))
      backend.add(frontend.process(sample));
    feed.note_changes(map.update(backend, true));
  }

  /// What waits in the tiles' queue.
  std::vector<TileIndex> take_tiles() {
    std::vector<TileIndex> out;
    const auto tile = std::make_unique<MapTile>();
    while (queues->tiles.consumer().try_pop(*tile)) out.push_back(tile->index);
    return out;
  }
  std::vector<WallInMap> take_walls() {
    std::vector<WallInMap> out;
    WallInMap wall;
    while (queues->walls.consumer().try_pop(wall)) out.push_back(wall);
    return out;
  }

  SensorModel sensor = SensorModel::crazyflie();
  Backend backend{BackendConfig{}, sensor, BeamLayout::multiranger()};
  MapBuilder map;
  std::unique_ptr<PublisherQueues> queues = std::make_unique<PublisherQueues>();
  MapFeed feed{queues->backend_outlet()};
};

TEST(MapFeed, HandsOverEveryChangedTileOnce) {
  MapFeedBench bench(0.1);
  EXPECT_FALSE(bench.feed.is_empty());
  bench.feed.flush(bench.backend, bench.map);
  EXPECT_TRUE(bench.feed.is_empty());
  EXPECT_EQ(bench.take_tiles(), bench.map.tiles());
  bench.feed.flush(bench.backend, bench.map);
  EXPECT_TRUE(bench.take_tiles().empty());
}

TEST(MapFeed, HandsOverTheConfidenceOfEachKeyframe) {
  MapFeedBench bench(0.1);
  bench.feed.hand_on_confidence(bench.backend, true);
  PoseConfidence confidence;
  ASSERT_TRUE(bench.queues->confidence.load_if_new(confidence));
  EXPECT_EQ(confidence.keyframe, bench.backend.keyframes().all().last_id());
  EXPECT_GT(confidence.from_start.xx, 0.0);
  TrackingFigures figures;
  ASSERT_TRUE(bench.queues->tracking.load_if_new(figures));
  EXPECT_EQ(figures.tracking, Tracking::kTracking);
  bench.feed.hand_on_confidence(bench.backend, false);
  EXPECT_TRUE(bench.queues->tracking.load_if_new(figures));
  EXPECT_FALSE(bench.queues->confidence.load_if_new(confidence)) << "neither a keyframe nor another state";
}

TEST(MapFeed, KeepsTheTilesThatTheQueueHasNoRoomForAndOffersThemAgain) {
  MapFeedBench bench(0.01);
  const std::vector<TileIndex> all = bench.map.tiles();
  ASSERT_GT(all.size(), TileQueue::capacity());
  bench.feed.flush(bench.backend, bench.map);
  EXPECT_FALSE(bench.feed.is_empty());
  std::vector<TileIndex> received = bench.take_tiles();
  EXPECT_EQ(received.size(), TileQueue::capacity());
  while (!bench.feed.is_empty() && received.size() < all.size()) {
    bench.feed.flush(bench.backend, bench.map);
    const std::vector<TileIndex> more = bench.take_tiles();
    received.insert(received.end(), more.begin(), more.end());
  }
  EXPECT_TRUE(bench.feed.is_empty());
  EXPECT_EQ(received, all);
  EXPECT_EQ(bench.queues->tiles.rejected_count(), 0U);
}

TEST(MapFeed, SendsEachWallAtItsPlaceInTheMapAndAgainOnlyWhenItMoved) {
  MapFeedBench bench(0.1);
  bench.feed.flush(bench.backend, bench.map);
  const std::vector<WallInMap> walls = bench.take_walls();
  ASSERT_EQ(walls.size(), bench.backend.walls().size());
  ASSERT_FALSE(walls.empty());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Wall& known = bench.backend.walls()[i];
    EXPECT_EQ(walls[i].id, known.id);
    const Point2 start_keyframe = bench.backend.T_map_keyframe(known.anchor).inverse() * walls[i].start_map;
    EXPECT_NEAR(start_keyframe.x_m, known.start_keyframe.x_m, 1e-9);
    EXPECT_NEAR(start_keyframe.y_m, known.start_keyframe.y_m, 1e-9);
  }
  bench.feed.note_changes({});
  bench.feed.flush(bench.backend, bench.map);
  EXPECT_TRUE(bench.take_walls().empty());
}

TEST(MapFeed, TakesBackTheWallsThatGoWithWhatIsPrunedAndSendsNoClosureTwice) {
  ForgetfulRun run;
  const MapBuilder map(MapConfig{}, run.sensor);
  const auto queues = std::make_unique<PublisherQueues>();
  MapFeed feed(queues->backend_outlet());
  std::map<LandmarkId, WallInMap> known;
  std::set<ClosureId> closures;
  std::size_t gone = 0;
  const auto receive = [&] {
    feed.note_changes({});
    feed.flush(run.backend, map);
    WallInMap wall;
    while (queues->walls.consumer().try_pop(wall)) {
      gone += wall.is_gone ? 1U : 0U;
      if (wall.is_gone) {
        EXPECT_EQ(known.erase(wall.id), 1U);
      } else {
        known[wall.id] = wall;
      }
    }
    ClosureUpdate closure;
    while (queues->closures.consumer().try_pop(closure))
      EXPECT_TRUE(closures.insert(closure.closure.id).second) << index_of(closure.closure.id);
  };
  run.fly([&](const Pruning& pruning) { feed.prune(run.backend, pruning); },
          [&](const BackendUpdate&) { receive(); });
  receive();
  EXPECT_GT(gone, 0U);
  EXPECT_EQ(known.size(), run.backend.walls().size());
  EXPECT_EQ(closures.size(), run.backend.counters().closures_accepted);
}

TEST(MapFeed, HandsOverTheCountersWithEachFlush) {
  MapFeedBench bench(0.1);
  bench.feed.flush(bench.backend, bench.map);
  BackendCounters counters;
  ASSERT_TRUE(bench.queues->backend.load_if_new(counters));
  EXPECT_EQ(counters.scans, kSamples);
}

TEST(MapFeed, SaysWhenNothingMoreWillCome) {
  MapFeedBench bench(0.1);
  EXPECT_FALSE(bench.queues->tiles.consumer().closed());
  bench.feed.close();
  EXPECT_TRUE(bench.queues->tiles.consumer().closed());
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/map_builder.hpp"

#include <gmock/gmock.h>

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "tests/core/mapping/room_flight.hpp"
#include "tests/support/dead_reckoning_frontend.hpp"
#include "tests/support/forgetful_run.hpp"
#include "tests/support/loop_corridor.hpp"

namespace swiftlet {
namespace {

const SensorModel kSensor = SensorModel::crazyflie();

int percent_at(const MapBuilder& map, double x_m, double y_m) {
  const double tile_m = kTileCells * map.config().resolution_m;
  const TileIndex index{static_cast<int>(std::floor(x_m / tile_m)),
                        static_cast<int>(std::floor(y_m / tile_m))};
  const auto column = static_cast<std::size_t>((x_m - index.x * tile_m) / map.config().resolution_m);
  const auto row = static_cast<std::size_t>((y_m - index.y * tile_m) / map.config().resolution_m);
  return map.tile(index).occupancy_percent[row * kTileCells + column];
}

void expect_same_map(const MapBuilder& a, const MapBuilder& b) {
  ASSERT_EQ(a.tiles(), b.tiles());
  for (const TileIndex index : a.tiles())
    EXPECT_EQ(a.tile(index).occupancy_percent, b.tile(index).occupancy_percent);
}

int cells_that_differ(const MapBuilder& a, const MapBuilder& b) {
  std::vector<TileIndex> indices = a.tiles();
  const std::vector<TileIndex> of_b = b.tiles();
  indices.insert(indices.end(), of_b.begin(), of_b.end());
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  int count = 0;
  for (const TileIndex index : indices) {
    const MapTile of_a = a.tile(index);
    for (std::size_t i = 0; i < kCellsInTile; ++i)
      count += of_a.occupancy_percent[i] != b.tile(index).occupancy_percent[i] ? 1 : 0;
  }
  return count;
}

TEST(MapBuilder, DrawsTheWallsOfARoomAndClearsItsMiddle) {
  Backend backend(without_loops(), kSensor, BeamLayout::multiranger());
  MapBuilder map(MapConfig{}, kSensor);
  for (const FrontendStep& step : room_flight(100)) {
    const BackendUpdate update = backend.add(step);
    map.update(backend, update.poses_changed);
  }
  // The flight begins at the map's origin, 5 m right of the room's centre line: walls at y = +-2.
  EXPECT_GT(percent_at(map, 3.02, 2.02), 60);
  EXPECT_GT(percent_at(map, 3.02, -1.98), 60);
  EXPECT_LT(percent_at(map, 3.02, 1.0), 45);
  EXPECT_LT(percent_at(map, 5.0, 0.02), 10);
  EXPECT_EQ(percent_at(map, 3.02, 3.0), -1);
}

TEST(MapBuilder, EachStoreyHasAMapOfItsOwn) {
  std::vector<FrontendStep> steps = room_flight(100);
  Backend backend(without_loops(), kSensor, BeamLayout::multiranger());
  MapBuilder map(MapConfig{}, kSensor);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i >= 50) steps[i].sample.storey = StoreyId{1};
    map.update(backend, backend.add(steps[i]).poses_changed);
  }
  EXPECT_THAT(map.storeys(), testing::ElementsAre(StoreyId{0}, StoreyId{1}));
  EXPECT_EQ(map.tiles(StoreyId{0}).size() + map.tiles(StoreyId{1}).size(), map.tiles().size());
  Backend only_above(without_loops(), kSensor, BeamLayout::multiranger());
  MapBuilder map_above(MapConfig{}, kSensor);
  for (FrontendStep step : steps) {
    if (step.sample.storey == StoreyId{0}) step.sample.status.fill(RangeStatus::kInvalid);
    map_above.update(only_above, only_above.add(step).poses_changed);
  }
  EXPECT_EQ(map.tiles(StoreyId{1}), map_above.tiles());
  for (const TileIndex index : map_above.tiles())
    EXPECT_EQ(map.tile(index).occupancy_percent, map_above.tile(index).occupancy_percent);
}

TEST(MapBuilder, ClearsAlongBeamsWithoutReturnUpToTheSensorsRange) {
  Backend backend(without_loops(), kSensor, BeamLayout::multiranger());
  MapBuilder map(MapConfig{}, kSensor);
  backend.add(room_flight(1).front());  // front: 11 m, no return; the sensor sees 3 m
  map.update(backend, false);
  EXPECT_EQ(percent_at(map, 2.92, 0.02), 40);
  EXPECT_EQ(percent_at(map, 3.12, 0.02), -1);
}

TEST(MapBuilder, SettlesWhereItHadBeenDrawnAtOnce) {
  Backend backend(without_loops(), kSensor, BeamLayout::multiranger());
  MapBuilder followed(MapConfig{}, kSensor);
  for (const FrontendStep& step : room_flight(100, 0.004)) {
    const BackendUpdate update = backend.add(step);
    followed.update(backend, update.poses_changed);
  }
  backend.finish();
  followed.settle(backend);
  MapBuilder drawn_at_once(MapConfig{}, kSensor);
  drawn_at_once.settle(backend);
  expect_same_map(followed, drawn_at_once);
}

TEST(MapBuilder, FollowsWhatRefinementMoves) {
  BackendConfig config;
  config.min_travel_between_m = 1000.0;  // no closures: whatever moves, refinement moved it
  Backend backend(config, kSensor, BeamLayout::multiranger());
  const MapConfig fine{.resolution_m = 0.02};  // refinement moves little here
  MapBuilder followed(fine, kSensor);
  MapBuilder never_told(fine, kSensor);
  for (const FrontendStep& step : room_flight(3000, 0.006)) {
    if (!step.has_keyframe) continue;  // so the window is longer than what the map follows anyway
    const BackendUpdate update = backend.add(step);
    followed.update(backend, update.poses_changed, update.refined);
    never_told.update(backend, update.poses_changed);
  }
  MapBuilder drawn_at_once(fine, kSensor);
  drawn_at_once.settle(backend);
  EXPECT_GT(cells_that_differ(never_told, drawn_at_once), 1000)
      << "refinement moves what the window does not";
  EXPECT_LT(4 * cells_that_differ(followed, drawn_at_once), 3 * cells_that_differ(never_told, drawn_at_once));
  followed.settle(backend);
  expect_same_map(followed, drawn_at_once);
}

TEST(MapBuilder, LeavesInPlaceWhatMovedByLessThanHalfACell) {
  std::vector<FrontendStep> steps = room_flight(100);
  Backend backend(without_loops(), kSensor, BeamLayout::multiranger());
  MapBuilder map(MapConfig{}, kSensor);
  for (const FrontendStep& step : steps) {
    backend.add(step);
    map.update(backend, false);
  }
  FrontendStep next =
      steps.back();  // a keyframe that moves the others a little, then one that moves them more
  for (const double shift_m : {-0.02, -0.04}) {
    next.sample.sequence += 1;
    next.sample.stamp += std::chrono::milliseconds(100);
    next.has_keyframe = true;
    next.made = steps[95].made;
    next.made.id = next.keyframe = next.keyframe + 1;
    next.made.T_local_keyframe.clear();
    for (std::uint32_t k = 0; k <= index_of(next.keyframe); ++k)
      (void)next.made.T_local_keyframe.try_push_back(Pose2(0.5 * k, k < 3 ? 0.0 : shift_m, 0.0));
    const MapTile before = map.tile({0, 0});
    backend.add(next);
    map.update(backend, true);
    EXPECT_EQ(before.occupancy_percent == map.tile({0, 0}).occupancy_percent, shift_m > -0.025) << shift_m;
  }
}

TEST(MapBuilder, FollowsWhenItIsAskedOnlyNowAndThen) {
  Backend backend(without_loops(), kSensor, BeamLayout::multiranger());
  MapBuilder seldom(MapConfig{}, kSensor);
  int count = 0;
  for (const FrontendStep& step : room_flight(100, 0.004)) {
    backend.add(step);
    if (++count % 37 == 0) seldom.update(backend, false);
  }
  seldom.update(backend, false);
  MapBuilder drawn_at_once(MapConfig{}, kSensor);
  drawn_at_once.update(backend, true);
  expect_same_map(seldom, drawn_at_once);
}

TEST(MapBuilder, DrawsWhatAVehicleSeesThatStands) {
  MapConfig config;
  config.tuning.drawing.max_returns_moved = 100;
  Backend backend(without_loops(), kSensor, BeamLayout::multiranger());
  MapBuilder map(config, kSensor);
  FrontendStep step = room_flight(1).front();
  map.update(backend, backend.add(step).poses_changed);
  step.has_keyframe = false;
  step.sample.starts_segment = false;
  int drawings = 0;
  for (int i = 0; i < 1000; ++i) {
    backend.add(step);
    if (!map.is_behind(backend)) continue;
    map.catch_up(backend);
    ++drawings;
  }
  EXPECT_EQ(drawings, 40);
  MapBuilder settled(config, kSensor);
  settled.settle(backend);
  expect_same_map(map, settled);
}

TEST(MapBuilder, ReportsExactlyTheTilesWhoseContentChanged) {
  Backend backend(without_loops(), kSensor, BeamLayout::multiranger());
  MapBuilder map(MapConfig{}, kSensor);
  const MapBuilder empty(MapConfig{}, kSensor);
  std::map<TileIndex, MapTile> seen;
  std::size_t left_alone = 0;
  for (const FrontendStep& step : room_flight(60, 0.004)) {
    backend.add(step);
    const std::vector<TileIndex> reported = map.update(backend, false);
    std::vector<TileIndex> changed;
    for (const TileIndex index : map.tiles()) seen.try_emplace(index, empty.tile(index));
    for (auto& [index, tile] : seen) {
      const MapTile now = map.tile(index);
      const bool is_same = now.occupancy_percent == tile.occupancy_percent;
      if (!is_same) changed.push_back(index);
      EXPECT_EQ(is_same, now.version == tile.version);
      tile = now;
    }
    EXPECT_EQ(reported, changed);
    left_alone += seen.size() - changed.size();
  }
  EXPECT_GT(left_alone, 0U);
}

TEST(MapBuilder, RubsOutWhatIsPruned) {
  ForgetfulRun run;
  MapBuilder followed(MapConfig{}, run.sensor);
  run.fly([&](const Pruning& pruning) { followed.prune(run.backend, pruning); },
          [&](const BackendUpdate& update) {
            followed.update(run.backend, update.poses_changed, update.refined);
          });
  ASSERT_GT(run.pruned_scans, 1000U);
  followed.settle(run.backend);
  MapBuilder drawn_at_once(MapConfig{}, run.sensor);
  drawn_at_once.settle(run.backend);
  expect_same_map(followed, drawn_at_once);
}

/// A lap and most of another, between which the vehicle comes to stand elsewhere.
class MapBuilderOfABrokenFlight : public testing::Test {
 protected:
  MapBuilderOfABrokenFlight() {
    fly_along(vehicle_, loop_corridor(), "bcda");
    break_ = vehicle_.samples().size();
    const Point2 start = loop_corridor().place('a');
    vehicle_.carry_to(loop_corridor(), Pose2(start.x_m + 0.7, start.y_m + 0.5, 0.2));
    fly_along(vehicle_, loop_corridor(), "bcd");
  }
  /// As the pipeline does it: the map follows at keyframes.
  void fly(const std::vector<RangeSample>& samples, const std::function<void()>& look) {
    DeadReckoningFrontend frontend;
    for (const RangeSample& sample : samples) {
      const FrontendStep step = frontend.process(sample);
      const BackendUpdate update = backend_.add(step);
      if (!step.has_keyframe) continue;
      map_.update(backend_, update.poses_changed, update.refined);
      look();
    }
  }
  /// Seen, and not in the map.
  [[nodiscard]] int cells_missing() const {
    MapBuilder all(MapConfig{}, kSensor);
    all.settle(backend_);
    int count = 0;
    for (const TileIndex index : all.tiles()) {
      const MapTile drawn = map_.tile(index);
      const MapTile seen = all.tile(index);
      for (std::size_t i = 0; i < kCellsInTile; ++i)
        count += drawn.occupancy_percent[i] < 0 && seen.occupancy_percent[i] >= 0 ? 1 : 0;
    }
    return count;
  }

  TestVehicle vehicle_ = vehicle_at_start({}, 6);
  std::size_t break_ = 0;
  Backend backend_{BackendConfig{}, kSensor, BeamLayout::multiranger()};
  MapBuilder map_{MapConfig{}, kSensor};
};

TEST_F(MapBuilderOfABrokenFlight, WaitsUntilThePlaceBehindARestartIsKnown) {
  int most_missing = 0;
  std::optional<ScanId> waited_from;
  fly(vehicle_.samples(), [&] {
    if (!backend_.doubted_since()) return;
    waited_from = backend_.doubted_since();
    most_missing = std::max(most_missing, cells_missing());
  });
  ASSERT_TRUE(waited_from);
  EXPECT_EQ(index_of(*waited_from), break_);
  EXPECT_GT(most_missing, 1000);
  ASSERT_FALSE(backend_.doubted_since()) << "the place was found";
  EXPECT_LT(cells_missing(), 200) << "some scans are up to half a cell from where they belong";
  backend_.finish();
  map_.settle(backend_);
  EXPECT_EQ(cells_missing(), 0);
}

TEST_F(MapBuilderOfABrokenFlight, TakesOutWhatWasDrawnSinceTheMapWasContradicted) {
  std::vector<RangeSample> samples = vehicle_.samples();
  const Pose2 T_odom_restarted = samples[break_ - 1].T_odom_body * samples[break_].T_odom_body.inverse();
  for (std::size_t i = break_; i < samples.size(); ++i) {  // unseen: the estimate runs on
    samples[i].T_odom_body = T_odom_restarted * samples[i].T_odom_body;
    samples[i].starts_segment = false;
  }
  std::optional<ScanId> doubted;
  int missing_before = 0;
  int missing_then = 0;
  fly(samples, [&] {
    if (index_of(backend_.scans().all().last_id()) < break_ || doubted) return;
    doubted = backend_.doubted_since();
    (doubted ? missing_then : missing_before) = cells_missing();
  });
  ASSERT_TRUE(doubted);
  EXPECT_GE(index_of(*doubted) + 10, break_);
  EXPECT_GT(missing_then, missing_before + 100);
}

TEST(MapBuilder, DrawsOnBehindARestartWhereNothingCanFindThePlace) {
  std::vector<FrontendStep> steps = room_flight(100);
  steps[60].sample.starts_segment = steps[60].made.starts_segment = true;
  Backend backend(without_loops(), kSensor, BeamLayout::multiranger());
  MapBuilder map(MapConfig{}, kSensor);
  for (const FrontendStep& step : steps) {
    backend.add(step);
    map.update(backend, false);
  }
  MapBuilder drawn_at_once(MapConfig{}, kSensor);
  drawn_at_once.settle(backend);
  expect_same_map(map, drawn_at_once);
}

TEST(MapBuilder, HoldsNothingBeforeTheFirstScan) {
  Backend backend(without_loops(), kSensor, BeamLayout::multiranger());
  MapBuilder map(MapConfig{}, kSensor);
  EXPECT_TRUE(map.update(backend, true).empty());
  EXPECT_TRUE(map.tiles().empty());
}

}  // namespace
}  // namespace swiftlet

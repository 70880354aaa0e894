// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/map_builder.hpp"

#include <gmock/gmock.h>

#include "tests/core/mapping/room_flight.hpp"
#include "tests/support/forgetful_run.hpp"

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
  for (const FrontendStep& step : room_flight(1500, 0.006)) {
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

TEST(MapBuilder, ReportsExactlyTheTilesWhoseContentChanged) {
  Backend backend(without_loops(), kSensor, BeamLayout::multiranger());
  MapBuilder map(MapConfig{}, kSensor);
  for (const FrontendStep& step : room_flight(60, 0.004)) {
    std::vector<MapTile> before;
    for (const TileIndex index : map.tiles()) before.push_back(map.tile(index));
    backend.add(step);
    const std::vector<TileIndex> changed = map.update(backend, false);
    EXPECT_TRUE(std::is_sorted(changed.begin(), changed.end()));
    for (const MapTile& tile : before) {
      const bool same = tile.occupancy_percent == map.tile(tile.index).occupancy_percent;
      EXPECT_EQ(same, !std::binary_search(changed.begin(), changed.end(), tile.index));
      EXPECT_EQ(same, tile.version == map.tile(tile.index).version);
    }
  }
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

TEST(MapBuilder, HoldsNothingBeforeTheFirstScan) {
  Backend backend(without_loops(), kSensor, BeamLayout::multiranger());
  MapBuilder map(MapConfig{}, kSensor);
  EXPECT_TRUE(map.update(backend, true).empty());
  EXPECT_TRUE(map.tiles().empty());
}

}  // namespace
}  // namespace swiftlet

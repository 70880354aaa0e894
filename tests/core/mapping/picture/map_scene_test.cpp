// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/map_scene.hpp"

#include <gmock/gmock.h>

#include "core/mapping/map_builder.hpp"
#include "tests/core/mapping/room_flight.hpp"

namespace swiftlet {
namespace {

TEST(MapScene, ShowsEveryScanWithItsOdometryBegunAtTheCorrectedStart) {
  Backend backend(without_loops(), SensorModel::crazyflie(), BeamLayout::multiranger());
  MapBuilder map(MapConfig{}, SensorModel::crazyflie());
  for (const FrontendStep& step : room_flight(41)) backend.add(step);
  map.update(backend, true);
  const MapScene scene = make_map_scene(backend, map);
  EXPECT_NEAR(scene.length_m, backend.scans().all().values().back().path_m, 1e-9);
  ASSERT_EQ(scene.scans.size(), 41U);
  EXPECT_TRUE(scene.scans[0].starts_segment);
  EXPECT_FALSE(scene.scans[1].starts_segment);
  EXPECT_NEAR(scene.scans[40].corrected_map.x_m, 4.0, 1e-9);
  EXPECT_NEAR(scene.scans[40].odometry_map.x_m, 4.0, 1e-9);
  EXPECT_EQ(scene.tiles.size(), map.tiles().size());
  EXPECT_EQ(scene.duration, std::chrono::seconds(4));
  EXPECT_EQ(scene.scans[40].stamp, scene.began + scene.duration);
}

TEST(MapScene, CarriesWallsWithTheirKeyframeAsFarAsTheGridBearsThemOut) {
  Backend backend(without_loops(), SensorModel::crazyflie(), BeamLayout::multiranger());
  MapBuilder map(MapConfig{}, SensorModel::crazyflie());
  for (const FrontendStep& step : room_flight(41)) backend.add(step);
  map.update(backend, false);
  const MapScene scene = make_map_scene(backend, map);
  ASSERT_EQ(scene.walls.size(), 1U);  // reported anew by every keyframe: the last word counts
  EXPECT_NEAR(scene.walls[0].start_map.x_m, 3.0, 1e-9);  // reported from 3 m to 5 m, the beams end at 4 m
  EXPECT_NEAR(scene.walls[0].end_map.x_m, 4.0, 0.2);
  EXPECT_NEAR(scene.walls[0].end_map.y_m, 2.0, 0.5 * map.config().resolution_m + 1e-9);  // fitted to cells
}

TEST(MapScene, OfNothingIsEmpty) {
  const Backend backend(without_loops(), SensorModel::crazyflie(), BeamLayout::multiranger());
  const MapBuilder map(MapConfig{}, SensorModel::crazyflie());
  const MapScene scene = make_map_scene(backend, map);
  EXPECT_TRUE(scene.scans.empty());
  EXPECT_TRUE(scene.tiles.empty());
  EXPECT_EQ(scene.duration, Duration::zero());
}

}  // namespace
}  // namespace swiftlet

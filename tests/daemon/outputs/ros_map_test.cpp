// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/ros_map.hpp"

#include <gmock/gmock.h>

namespace swiftlet {
namespace {

MapTile unknown_tile(TileIndex index) {
  MapTile tile;
  tile.index = index;
  tile.occupancy_percent.fill(-1);
  return tile;
}

std::uint8_t pixel(const RosMap& map, int column, int row_from_top) {
  return map.pixels[static_cast<std::size_t>(row_from_top) * static_cast<std::size_t>(map.width) +
                    static_cast<std::size_t>(column)];
}

TEST(PgmValue, FollowsMapServersTrinaryValues) {
  EXPECT_EQ(pgm_value(-1), 205);
  EXPECT_EQ(pgm_value(0), 254);
  EXPECT_EQ(pgm_value(44), 254);
  EXPECT_EQ(pgm_value(45), 205);
  EXPECT_EQ(pgm_value(64), 205);
  EXPECT_EQ(pgm_value(65), 0);
  EXPECT_EQ(pgm_value(100), 0);
}

TEST(PgmValue, IsReadBackByTheThresholdsOfTheYaml) {
  const auto occupancy = [](std::uint8_t value) { return (255.0 - value) / 255.0; };
  EXPECT_GT(occupancy(kPgmOccupied), 0.65);
  EXPECT_LT(occupancy(kPgmFree), 0.196);
  EXPECT_GT(occupancy(kPgmUnknown), 0.196);
  EXPECT_LT(occupancy(kPgmUnknown), 0.65);
}

TEST(RosMap, PutsTheHighestRowFirst) {
  MapTile tile = unknown_tile({0, 0});
  tile.occupancy_percent[0] = 98;                // lower left cell
  tile.occupancy_percent[kCellsInTile - 1] = 2;  // upper right cell
  const RosMap map = make_ros_map({&tile, 1}, 0.05);
  EXPECT_EQ(map.width, kTileCells);
  EXPECT_EQ(map.height, kTileCells);
  EXPECT_EQ(pixel(map, 0, kTileCells - 1), kPgmOccupied);
  EXPECT_EQ(pixel(map, kTileCells - 1, 0), kPgmFree);
  EXPECT_EQ(pixel(map, 0, 0), kPgmUnknown);
}

TEST(RosMap, CoversAllTilesInAnyOrder) {
  MapTile low = unknown_tile({-2, -1});
  MapTile high = unknown_tile({0, 1});
  low.occupancy_percent[0] = 98;
  high.occupancy_percent[kCellsInTile - 1] = 98;
  const std::vector<MapTile> forth = {low, high};
  const std::vector<MapTile> back = {high, low};
  const RosMap map = make_ros_map(forth, 0.05);
  EXPECT_EQ(map.width, 3 * kTileCells);
  EXPECT_EQ(map.height, 3 * kTileCells);
  EXPECT_DOUBLE_EQ(map.origin_map.x_m, -2 * kTileCells * 0.05);
  EXPECT_DOUBLE_EQ(map.origin_map.y_m, -1 * kTileCells * 0.05);
  EXPECT_EQ(pixel(map, 0, map.height - 1), kPgmOccupied);
  EXPECT_EQ(pixel(map, map.width - 1, 0), kPgmOccupied);
  EXPECT_EQ(pgm_text(map), pgm_text(make_ros_map(back, 0.05)));
}

TEST(RosMap, OfNothingIsOneUnknownTile) {
  const RosMap map = make_ros_map({}, 0.05);
  EXPECT_EQ(map.pixels.size(), kCellsInTile);
  EXPECT_THAT(map.pixels, testing::Each(kPgmUnknown));
}

TEST(RosMap, WritesTheTwoFiles) {
  const MapTile tile = unknown_tile({-1, 2});
  const RosMap map = make_ros_map({&tile, 1}, 0.05);
  EXPECT_EQ(pgm_text(map).substr(0, 13), "P5\n64 64\n255\n");
  EXPECT_EQ(pgm_text(map).size(), 13U + 64U * 64U);
  EXPECT_EQ(ros_map_yaml(map, 0.05, "map.pgm"),
            "image: map.pgm\n"
            "mode: trinary\n"
            "resolution: 0.050000\n"
            "origin: [-3.200000, 6.400000, 0.0]\n"
            "negate: 0\n"
            "occupied_thresh: 0.65\n"
            "free_thresh: 0.196\n");
}

}  // namespace
}  // namespace swiftlet

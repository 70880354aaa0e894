// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/ros_map.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace swiftlet {
namespace {

MapTile unknown_tile(TileIndex index) {
  MapTile tile;
  tile.index = index;
  tile.occupancy_percent.fill(-1);
  return tile;
}

/// A PGM file, read back.
struct Image {
  std::size_t width = 0;
  std::size_t height = 0;
  std::string pixels;

  [[nodiscard]] std::uint8_t pixel(std::size_t column, std::size_t row_from_top) const {
    return static_cast<std::uint8_t>(pixels.at(row_from_top * width + column));
  }
};

std::vector<TileIndex> indices_of(const std::vector<MapTile>& tiles) {
  std::vector<TileIndex> indices;
  indices.reserve(tiles.size());
  for (const MapTile& tile : tiles) indices.push_back(tile.index);
  return indices;
}

std::string pgm_of(const std::vector<MapTile>& tiles) {
  std::string bytes;
  const auto content = [&](TileIndex index) {
    return *std::find_if(tiles.begin(), tiles.end(),
                         [index](const MapTile& tile) { return tile.index == index; });
  };
  write_pgm(indices_of(tiles), content, [&bytes](std::string_view piece) {
    bytes += piece;
    return true;
  });
  return bytes;
}

Image image_of(const std::vector<MapTile>& tiles) {
  const std::string bytes = pgm_of(tiles);
  std::istringstream header(bytes);
  std::string kind;
  int brightest = 0;
  Image image;
  header >> kind >> image.width >> image.height >> brightest;
  EXPECT_EQ(kind, "P5");
  EXPECT_EQ(brightest, 255);
  image.pixels = bytes.substr(static_cast<std::size_t>(header.tellg()) + 1);  // after one white space
  EXPECT_EQ(image.pixels.size(), image.width * image.height);
  return image;
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
  const Image image = image_of({tile});
  EXPECT_EQ(image.width, std::size_t{kTileCells});
  EXPECT_EQ(image.height, std::size_t{kTileCells});
  EXPECT_EQ(image.pixel(0, kTileCells - 1), kPgmOccupied);
  EXPECT_EQ(image.pixel(kTileCells - 1, 0), kPgmFree);
  EXPECT_EQ(image.pixel(0, 0), kPgmUnknown);
}

TEST(RosMap, CoversAllTilesInAnyOrder) {
  MapTile low = unknown_tile({-2, -1});
  MapTile high = unknown_tile({0, 1});
  low.occupancy_percent[0] = 98;
  high.occupancy_percent[kCellsInTile - 1] = 98;
  const Image image = image_of({low, high});
  EXPECT_EQ(image.width, 3 * std::size_t{kTileCells});
  EXPECT_EQ(image.height, 3 * std::size_t{kTileCells});
  EXPECT_EQ(image.pixel(0, image.height - 1), kPgmOccupied);
  EXPECT_EQ(image.pixel(image.width - 1, 0), kPgmOccupied);
  EXPECT_EQ(std::count(image.pixels.begin(), image.pixels.end(), static_cast<char>(kPgmOccupied)), 2);
  EXPECT_EQ(pgm_of({low, high}), pgm_of({high, low}));
}

TEST(RosMap, OfNothingIsOneUnknownTile) {
  const Image image = image_of({});
  EXPECT_EQ(image.pixels.size(), kCellsInTile);
  EXPECT_THAT(image.pixels, testing::Each(static_cast<char>(kPgmUnknown)));
}

TEST(RosMap, HandsOnOneRowOfTilesAtATime) {
  const std::vector<TileIndex> tiles = {{0, 0}, {1, 9}};
  std::size_t longest = 0;
  write_pgm(tiles, unknown_tile, [&](std::string_view piece) {
    longest = std::max(longest, piece.size());
    return true;
  });
  EXPECT_EQ(longest, 2 * kCellsInTile);
}

TEST(RosMap, SaysWhereTheLowestCornerLies) {
  const std::vector<TileIndex> tiles = {{-1, 5}, {3, 2}};
  EXPECT_EQ(ros_map_yaml(tiles, 0.05, "map.pgm"),
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

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/ros_map.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>

namespace swiftlet {

namespace {

struct TileRange {
  TileIndex low;
  TileIndex high;
};

TileRange range_of(std::span<const MapTile> tiles) {
  if (tiles.empty()) return {};
  TileRange range{tiles.front().index, tiles.front().index};
  for (const MapTile& tile : tiles) {
    range.low = {std::min(range.low.x, tile.index.x), std::min(range.low.y, tile.index.y)};
    range.high = {std::max(range.high.x, tile.index.x), std::max(range.high.y, tile.index.y)};
  }
  return range;
}

void copy_tile(RosMap& map, const MapTile& tile, TileIndex low) {
  for (int row = 0; row < kTileCells; ++row) {
    const int y_from_bottom = (tile.index.y - low.y) * kTileCells + row;
    const int first_column = (tile.index.x - low.x) * kTileCells;
    const auto from = tile.occupancy_percent.begin() + static_cast<std::ptrdiff_t>(row) * kTileCells;
    const auto to = map.pixels.begin() +
                    static_cast<std::ptrdiff_t>(map.height - 1 - y_from_bottom) * map.width + first_column;
    std::transform(from, from + kTileCells, to, pgm_value);
  }
}

std::string number(double value) {
  char text[32];
  const int size = std::snprintf(text, sizeof text, "%.6f", value);
  return {text, static_cast<std::size_t>(size)};
}

}  // namespace

RosMap make_ros_map(std::span<const MapTile> tiles, double resolution_m) {
  const TileRange range = range_of(tiles);
  RosMap map;
  map.width = (range.high.x - range.low.x + 1) * kTileCells;
  map.height = (range.high.y - range.low.y + 1) * kTileCells;
  map.origin_map = {range.low.x * kTileCells * resolution_m, range.low.y * kTileCells * resolution_m};
  map.pixels.assign(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height), kPgmUnknown);
  for (const MapTile& tile : tiles) copy_tile(map, tile, range.low);
  return map;
}

std::string pgm_text(const RosMap& map) {
  std::string text = "P5\n" + std::to_string(map.width) + " " + std::to_string(map.height) + "\n255\n";
  text.reserve(text.size() + map.pixels.size());
  text.append(map.pixels.begin(), map.pixels.end());
  return text;
}

std::string ros_map_yaml(const RosMap& map, double resolution_m, const std::string& pgm_name) {
  return "image: " + pgm_name + "\nmode: trinary\nresolution: " + number(resolution_m) + "\norigin: [" +
         number(map.origin_map.x_m) + ", " + number(map.origin_map.y_m) +
         ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

}  // namespace swiftlet

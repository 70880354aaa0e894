// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/ros_map.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>

namespace swiftlet {

namespace {

/// Into the pixels of its row of tiles, which come from the top as well.
void copy_tile(const MapTile& tile, const TileRange& range, std::string& pixels) {
  const std::size_t left = static_cast<std::size_t>(tile.index.x - range.low.x) * kTileCells;
  for (std::size_t row = 0; row < kTileCells; ++row) {
    const auto from = tile.occupancy_percent.begin() + static_cast<std::ptrdiff_t>(row * kTileCells);
    const std::size_t row_from_top = kTileCells - 1 - row;
    const auto to = pixels.begin() + static_cast<std::ptrdiff_t>(row_from_top * range.width_cells() + left);
    std::transform(from, from + kTileCells, to,
                   [](std::int8_t percent) { return static_cast<char>(pgm_value(percent)); });
  }
}

std::string number(double value) {
  char text[32];
  const int size = std::snprintf(text, sizeof text, "%.6f", value);
  return {text, static_cast<std::size_t>(size)};
}

}  // namespace

TileRange range_of(std::span<const TileIndex> tiles) {
  if (tiles.empty()) return {};
  TileRange range{tiles.front(), tiles.front()};
  for (const TileIndex index : tiles) {
    range.low = {std::min(range.low.x, index.x), std::min(range.low.y, index.y)};
    range.high = {std::max(range.high.x, index.x), std::max(range.high.y, index.y)};
  }
  return range;
}

void write_pgm(std::span<const TileIndex> tiles, const TileContent& content, const FileSink& write) {
  const TileRange range = range_of(tiles);
  bool goes_on = write("P5\n" + std::to_string(range.width_cells()) + " " +
                       std::to_string(range.height_cells()) + "\n255\n");
  std::string pixels;
  for (std::int32_t y = range.high.y; goes_on && y >= range.low.y; --y) {
    pixels.assign(range.width_cells() * kTileCells, static_cast<char>(kPgmUnknown));
    for (const TileIndex index : tiles)
      if (index.y == y) copy_tile(content(index), range, pixels);
    goes_on = write(pixels);
  }
}

std::string ros_map_yaml(std::span<const TileIndex> tiles, double resolution_m, const std::string& pgm_name) {
  const TileIndex corner = range_of(tiles).low;
  return "image: " + pgm_name + "\nmode: trinary\nresolution: " + number(resolution_m) + "\norigin: [" +
         number(corner.x * kTileCells * resolution_m) + ", " + number(corner.y * kTileCells * resolution_m) +
         ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "core/mapping/map_tile.hpp"
#include "daemon/outputs/file_writer.hpp"

namespace swiftlet {

// The map as ROS's map_server reads it (https://wiki.ros.org/map_server, mode trinary): an image, and a YAML
// file with its place. Both cover all tiles, in whole tiles; where there is none, the one at the
// origin. The order of the tiles does not matter.

inline constexpr std::uint8_t kPgmOccupied = 0;
inline constexpr std::uint8_t kPgmFree = 254;
inline constexpr std::uint8_t kPgmUnknown = 205;

/// The value of a cell in map.pgm.
[[nodiscard]] constexpr std::uint8_t pgm_value(std::int8_t occupancy_percent) {
  if (occupancy_percent < 0) return kPgmUnknown;
  if (occupancy_percent >= kOccupiedFromPercent) return kPgmOccupied;
  return occupancy_percent < kFreeBelowPercent ? kPgmFree : kPgmUnknown;
}

/// The rectangle around tiles, both corners included.
struct TileRange {
  TileIndex low;
  TileIndex high;

  [[nodiscard]] std::size_t width_cells() const {
    return static_cast<std::size_t>(high.x - low.x + 1) * kTileCells;
  }
  [[nodiscard]] std::size_t height_cells() const {
    return static_cast<std::size_t>(high.y - low.y + 1) * kTileCells;
  }
};
/// Around all of them; where there is none, the one at the origin.
[[nodiscard]] TileRange range_of(std::span<const TileIndex> tiles);

/// The content of one of the tiles.
using TileContent = std::function<MapTile(TileIndex)>;

/// Hands the bytes of a binary PGM file to the sink, one row of tiles at a time from the top, which is the
/// highest y: a building's map at once is tens of megabytes. Asks for each tile once.
void write_pgm(std::span<const TileIndex> tiles, const TileContent& content, const FileSink& write);
/// The YAML file beside it.
[[nodiscard]] std::string ros_map_yaml(std::span<const TileIndex> tiles, double resolution_m,
                                       const std::string& pgm_name);

}  // namespace swiftlet

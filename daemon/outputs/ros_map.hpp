// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/mapping/map_tile.hpp"

namespace swiftlet {

/// The map as ROS's map_server reads it (https://wiki.ros.org/map_server, mode trinary).
struct RosMap {
  int width = 0;
  int height = 0;
  Point2 origin_map;                 ///< lower left corner of the lower left cell
  std::vector<std::uint8_t> pixels;  ///< row by row from the top, which is the highest y
};

inline constexpr std::uint8_t kPgmOccupied = 0;
inline constexpr std::uint8_t kPgmFree = 254;
inline constexpr std::uint8_t kPgmUnknown = 205;

/// What map.pgm says of a cell: occupied from 65 percent on, free below 45 (beams passed and none, or few,
/// ended there), and unknown where nothing is known or beams disagree.
[[nodiscard]] constexpr std::uint8_t pgm_value(std::int8_t occupancy_percent) {
  if (occupancy_percent < 0) return kPgmUnknown;
  if (occupancy_percent >= 65) return kPgmOccupied;
  return occupancy_percent < 45 ? kPgmFree : kPgmUnknown;
}

/// Covers all tiles, in whole tiles; where there is none, the one at the origin. The order of the tiles does
/// not matter.
[[nodiscard]] RosMap make_ros_map(std::span<const MapTile> tiles, double resolution_m);

/// The bytes of a binary PGM file.
[[nodiscard]] std::string pgm_text(const RosMap& map);
/// The YAML file beside it.
[[nodiscard]] std::string ros_map_yaml(const RosMap& map, double resolution_m, const std::string& pgm_name);

}  // namespace swiftlet

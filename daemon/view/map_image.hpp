// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "daemon/view/run_history.hpp"

namespace swiftlet {

/// The tiles of a map in one piece.
struct MapImage {
  double left_m = 0.0;    ///< frame map: x and
  double bottom_m = 0.0;  ///< y of its lower left corner
  double cell_m = 0.0;
  std::uint32_t columns = 0;
  /// Row by row from the lowest y, each from the lowest x: 0..100 percent occupied, -1 unknown.
  std::vector<std::int8_t> occupancy_percent;
};

/// A map of more cells than this is made coarser: a cell is as occupied as its most occupied part.
inline constexpr std::int64_t kMaxImageCells = 16'000'000;

/// `at_us`: as it was then; unset: the newest. nullopt: there were no tiles.
[[nodiscard]] std::optional<MapImage> map_image(const RunHistory& history, std::optional<std::int64_t> at_us,
                                                std::int64_t max_cells = kMaxImageCells);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::span<const std::int8_t> bytes);

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/base/ids.hpp"

namespace swiftlet {

inline constexpr int kTileCells = 64;  ///< cells along one side of a tile
inline constexpr std::size_t kCellsInTile = std::size_t{kTileCells} * kTileCells;
// For formats that know occupied, free and unknown alone. In between, beams disagree.
inline constexpr int kOccupiedFromPercent = 65;
inline constexpr int kFreeBelowPercent = 45;  ///< beams passed, and none, or few, ended there

/// Which tile: tile (x, y) covers map coordinates [64 x, 64 x + 64) * resolution, likewise y. Each storey has
/// a map of its own.
struct TileIndex {
  std::int32_t x = 0;
  std::int32_t y = 0;
  StoreyId storey{};
  auto operator<=>(const TileIndex&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// One square of the map, complete in itself; crosses queues by value.
struct MapTile {
  TileIndex index;
  std::uint32_t version = 0;  ///< counts up with every change of this tile
  /// Row by row from the lowest y, each from the lowest x: 0..100 percent occupied, -1 unknown.
  std::array<std::int8_t, kCellsInTile> occupancy_percent{};
};
static_assert(std::is_trivially_copyable_v<MapTile>);

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/mapping/cell_walk.hpp"
#include "core/mapping/map_config.hpp"
#include "core/mapping/map_tile.hpp"

namespace swiftlet {

/// What beams said about one cell. Integers, so that what was counted can be taken back exactly.
struct CellCounts {
  std::uint32_t hits = 0;    ///< beams that ended here
  std::uint32_t misses = 0;  ///< beams that passed through
};

/// 0..100 percent occupied, -1 where nothing was counted. Log odds add up over independent beams (H. Moravec
/// and A. Elfes, "High resolution maps from wide angle sonar", ICRA 1985; Thrun, Burgard & Fox,
/// "Probabilistic Robotics", Algorithm 9.2); the sum is limited to +-kMaxLogOdds.
[[nodiscard]] std::int8_t occupancy_percent(const CellCounts& counts, const MapConfig& config);

inline constexpr double kMaxLogOdds = 4.0;  ///< between 2 and 98 percent

/// The cells of the map, in tiles that exist where something is counted. Allocates as the map grows.
/// One thread at a time.
class TileStore {
 public:
  explicit TileStore(const MapConfig& config);

  enum class Change : std::uint8_t { kCount, kTakeBack };
  /// Preconditions: what is taken back was counted before.
  void add_hit(CellIndex cell, Change change) { count(cell, change, &NarrowCounts::hits, &CellCounts::hits); }
  void add_miss(CellIndex cell, Change change) {
    count(cell, change, &NarrowCounts::misses, &CellCounts::misses);
  }

  /// Brings the percentages up to date with the counts. Returns the tiles in which any changed, in index
  /// order, each with its version counted up.
  std::vector<TileIndex> publish();

  /// As last published; a tile that never held anything has version 0 and is unknown all over.
  [[nodiscard]] MapTile tile(TileIndex index) const;
  /// Tiles with at least one known cell as last published, in index order.
  [[nodiscard]] std::vector<TileIndex> tiles() const;

 private:
  /// The lower halves of CellCounts: few cells ever need more.
  struct NarrowCounts {
    std::uint16_t hits = 0;
    std::uint16_t misses = 0;
  };
  struct Tile {
    std::array<NarrowCounts, kCellsInTile> counts{};
    std::map<std::size_t, CellCounts> carries;  ///< upper halves, of the cells that have them
    MapTile published;
    bool touched = false;  ///< counted in since the last publish()
    bool empty = true;     ///< as published: no cell is known

    [[nodiscard]] CellCounts counts_at(std::size_t i) const {
      const NarrowCounts& low = counts[i];
      const auto high = carries.empty() ? carries.end() : carries.find(i);
      if (high == carries.end()) return {low.hits, low.misses};
      return {low.hits + (high->second.hits << 16U), low.misses + (high->second.misses << 16U)};
    }
  };

  void count(CellIndex cell, Change change, std::uint16_t NarrowCounts::*low,
             std::uint32_t CellCounts::*high) {
    // Tiles are a power of two wide: shifting and masking round downwards for negative cells too.
    const TileIndex index{cell.x >> kTileShift, cell.y >> kTileShift};
    if (last_tile_ == nullptr || index != last_tile_->published.index) last_tile_ = &touch(index);
    const auto column = static_cast<std::uint32_t>(cell.x) & (kTileCells - 1U);
    const auto row = static_cast<std::uint32_t>(cell.y) & (kTileCells - 1U);
    const std::size_t i = row * kTileCells + column;
    std::uint16_t& counted = last_tile_->counts[i].*low;
    if (change == Change::kCount) {
      if (++counted == 0) ++(last_tile_->carries[i].*high);
    } else {
      if (counted-- == 0) --(last_tile_->carries[i].*high);
    }
  }
  Tile& touch(TileIndex index);
  [[nodiscard]] MapTile unknown_tile(TileIndex index) const;
  bool refresh(Tile& tile) const;
  [[nodiscard]] std::int8_t percent_of(const CellCounts& counts) const {
    if (counts.hits >= kTableHits || counts.misses >= kTableMisses) return occupancy_percent(counts, config_);
    return percent_table_[counts.hits * kTableMisses + counts.misses];
  }

  static constexpr int kTileShift = 6;
  static_assert(kTileCells == 1 << kTileShift);

  // Most cells have small counts; looking them up makes publishing a tile cheap enough for every sample.
  static constexpr std::uint32_t kTableHits = 32;
  static constexpr std::uint32_t kTableMisses = 128;

  MapConfig config_;
  std::vector<std::int8_t> percent_table_;
  std::map<TileIndex, std::unique_ptr<Tile>> tiles_;  ///< those that hold anything, or were touched since
  std::map<TileIndex, std::uint32_t> emptied_;        ///< versions of those that did once
  Tile* last_tile_ = nullptr;  ///< the tile counted in last, touched; null after publish()
};

}  // namespace swiftlet

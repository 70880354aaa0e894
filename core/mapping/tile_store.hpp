// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/geometry/grid.hpp"
#include "core/mapping/map_config.hpp"
#include "core/mapping/map_tile.hpp"

namespace swiftlet {

/// What beams measured in one cell. Integers, so that what was counted can be taken back exactly.
struct CellCounts {
  std::uint32_t hits = 0;    ///< beams that ended here
  std::uint32_t misses = 0;  ///< beams that passed through
};

/// 0..100 percent occupied, -1 where nothing was counted. Log odds add up over independent beams (H. Moravec
/// and A. Elfes, "High resolution maps from wide angle sonar", ICRA 1985; Thrun, Burgard & Fox,
/// "Probabilistic Robotics", Algorithm 9.2); the sum is limited on both sides.
[[nodiscard]] std::int8_t occupancy_percent(const CellCounts& counts, const MapConfig& config);

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
  /// Where cells are counted from now on; the first storey at the beginning.
  void enter(StoreyId storey) {
    if (storey != storey_) last_tile_ = nullptr;
    storey_ = storey;
  }

  /// Brings the percentages up to date with the counts. Returns the tiles in which any changed, in index
  /// order, each with its version counted up.
  std::vector<TileIndex> publish();

  /// As last published; a tile that never held anything has version 0 and is unknown all over.
  [[nodiscard]] MapTile tile(TileIndex index) const;
  /// Tiles with at least one known cell as last published, in index order.
  [[nodiscard]] std::vector<TileIndex> tiles() const;

 private:
  /// One byte of each of CellCounts.
  struct NarrowCounts {
    std::uint8_t hits = 0;
    std::uint8_t misses = 0;
  };
  using CountPlane = std::array<NarrowCounts, kCellsInTile>;
  /// Counts lie byte over byte: most tiles never need more than the lowest, where none lingers or returns.
  struct Tile {
    CountPlane low{};
    std::unique_ptr<CountPlane> middle;         ///< once a count of this tile has needed it
    std::map<std::size_t, CellCounts> carries;  ///< what is above both, of the few cells that have it
    MapTile published;
    bool touched = false;  ///< counted in since the last publish()
    bool empty = true;     ///< as published: no cell is known

    [[nodiscard]] CellCounts counts_at(std::size_t i) const {
      if (middle == nullptr) return {low[i].hits, low[i].misses};
      return wide_counts_at(i);
    }
    [[nodiscard]] CellCounts wide_counts_at(std::size_t i) const;
    /// The lowest byte of a count has run over, or below 0.
    void carry(std::size_t i, std::uint8_t NarrowCounts::*narrow, std::uint32_t CellCounts::*wide);
    void borrow(std::size_t i, std::uint8_t NarrowCounts::*narrow, std::uint32_t CellCounts::*wide);
  };

  void count(CellIndex cell, Change change, std::uint8_t NarrowCounts::*narrow,
             std::uint32_t CellCounts::*wide) {
    // Tiles are a power of two wide: shifting and masking round downwards for negative cells too.
    const std::int32_t x = cell.x >> kTileShift;
    const std::int32_t y = cell.y >> kTileShift;
    if (last_tile_ == nullptr || x != last_tile_->published.index.x || y != last_tile_->published.index.y)
      last_tile_ = &touch({x, y, storey_});
    const auto column = static_cast<std::uint32_t>(cell.x) & (kTileCells - 1U);
    const auto row = static_cast<std::uint32_t>(cell.y) & (kTileCells - 1U);
    const std::size_t i = row * kTileCells + column;
    std::uint8_t& counted = last_tile_->low[i].*narrow;
    if (change == Change::kCount) {
      if (++counted == 0) last_tile_->carry(i, narrow, wide);
    } else {
      if (counted-- == 0) last_tile_->borrow(i, narrow, wide);
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
  StoreyId storey_{};
  Tile* last_tile_ = nullptr;  ///< the tile of that storey counted in last, touched; null after publish()
};

}  // namespace swiftlet

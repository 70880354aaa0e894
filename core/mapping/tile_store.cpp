// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/tile_store.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"

namespace swiftlet {

std::int8_t occupancy_percent(const CellCounts& counts, const MapConfig& config) {
  if (counts.hits == 0 && counts.misses == 0) return -1;
  const double log_odds = counts.hits * config.hit_log_odds + counts.misses * config.miss_log_odds;
  const double limit = config.tuning.drawing.max_log_odds;
  const double limited = std::clamp(log_odds, -limit, limit);
  return static_cast<std::int8_t>(std::lround(100.0 / (1.0 + std::exp(-limited))));
}

TileStore::TileStore(const MapConfig& config) : config_(config) {
  for (std::uint32_t hits = 0; hits < kTableHits; ++hits)
    for (std::uint32_t misses = 0; misses < kTableMisses; ++misses)
      percent_table_.push_back(occupancy_percent({hits, misses}, config));
}

CellCounts TileStore::Tile::wide_counts_at(std::size_t i) const {
  const NarrowCounts& above = (*middle)[i];
  const auto carried = carries.empty() ? carries.end() : carries.find(i);
  const CellCounts top = carried == carries.end() ? CellCounts{} : carried->second;
  return {low[i].hits + (std::uint32_t{above.hits} << 8U) + (top.hits << 16U),
          low[i].misses + (std::uint32_t{above.misses} << 8U) + (top.misses << 16U)};
}

void TileStore::Tile::carry(std::size_t i, std::uint8_t NarrowCounts::*narrow,
                            std::uint32_t CellCounts::*wide) {
  if (middle == nullptr) middle = std::make_unique<CountPlane>();
  if (++((*middle)[i].*narrow) == 0) ++(carries[i].*wide);
}

void TileStore::Tile::borrow(std::size_t i, std::uint8_t NarrowCounts::*narrow,
                             std::uint32_t CellCounts::*wide) {
  SWIFTLET_CHECK(middle != nullptr, "what is taken back was counted");
  if (((*middle)[i].*narrow)-- == 0) --(carries[i].*wide);
}

TileStore::Tile& TileStore::touch(TileIndex index) {
  std::unique_ptr<Tile>& tile = tiles_[index];
  if (tile == nullptr) {
    tile = std::make_unique<Tile>();
    tile->published = unknown_tile(index);
    emptied_.erase(index);
  }
  tile->touched = true;
  return *tile;
}

bool TileStore::refresh(Tile& tile) const {
  bool changed = false;
  bool empty = true;
  for (std::size_t i = 0; i < kCellsInTile; ++i) {
    const std::int8_t percent = percent_of(tile.counts_at(i));
    empty = empty && percent < 0;
    if (percent == tile.published.occupancy_percent[i]) continue;
    tile.published.occupancy_percent[i] = percent;
    changed = true;
  }
  tile.touched = false;
  tile.empty = empty;
  if (changed) ++tile.published.version;
  return changed;
}

std::vector<TileIndex> TileStore::publish() {
  last_tile_ = nullptr;
  std::vector<TileIndex> changed;
  for (auto at = tiles_.begin(); at != tiles_.end();) {
    Tile& tile = *at->second;
    if (tile.touched && refresh(tile)) changed.push_back(at->first);
    if (tile.empty) {
      if (tile.published.version > 0) emptied_[at->first] = tile.published.version;
      at = tiles_.erase(at);
    } else {
      ++at;
    }
  }
  return changed;
}

MapTile TileStore::unknown_tile(TileIndex index) const {
  const auto emptied = emptied_.find(index);
  MapTile unknown{.index = index, .version = emptied == emptied_.end() ? 0 : emptied->second};
  unknown.occupancy_percent.fill(-1);
  return unknown;
}

MapTile TileStore::tile(TileIndex index) const {
  const auto found = tiles_.find(index);
  if (found != tiles_.end()) return found->second->published;
  return unknown_tile(index);
}

std::vector<TileIndex> TileStore::tiles() const {
  std::vector<TileIndex> indices;
  for (const auto& [index, tile] : tiles_)
    if (!tile->empty) indices.push_back(index);  // what was touched since is not published
  return indices;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/map_image.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "daemon/view/page_messages.hpp"

namespace swiftlet {
namespace {

struct Extent {
  TileIndex lowest;
  TileIndex highest;  // inclusive

  [[nodiscard]] std::int64_t columns() const { return std::int64_t{kTileCells} * (highest.x - lowest.x + 1); }
  [[nodiscard]] std::int64_t rows() const { return std::int64_t{kTileCells} * (highest.y - lowest.y + 1); }
};

std::vector<TileAsOf> tiles_as_of(const RunHistory& history, std::optional<std::int64_t> at_us) {
  std::vector<TileAsOf> tiles;
  const StoreyId storey = history.storey_at(at_us);
  for (const auto& [index, versions] : history.tiles()) {
    if (index.storey != storey) continue;
    const auto* const entry = at_us ? versions.at(*at_us) : versions.newest();
    if (entry != nullptr) tiles.emplace_back(index, &entry->value);
  }
  return tiles;
}

/// Precondition: there is a tile.
Extent extent_of(std::span<const TileAsOf> tiles) {
  Extent extent{tiles.front().first, tiles.front().first};
  for (const auto& [index, tile] : tiles) {
    extent.lowest = {std::min(extent.lowest.x, index.x), std::min(extent.lowest.y, index.y)};
    extent.highest = {std::max(extent.highest.x, index.x), std::max(extent.highest.y, index.y)};
  }
  return extent;
}

/// How many cells become one along each side: a power of two.
std::int64_t coarseness(const Extent& extent, std::int64_t max_cells) {
  std::int64_t factor = 1;
  while ((extent.columns() / factor + 1) * (extent.rows() / factor + 1) > max_cells) factor *= 2;
  return factor;
}

std::int64_t divided_up(std::int64_t number, std::int64_t divisor) {
  return (number + divisor - 1) / divisor;
}

}  // namespace

std::optional<MapImage> map_image(const RunHistory& history, std::optional<std::int64_t> at_us,
                                  std::int64_t max_cells) {
  const std::vector<TileAsOf> tiles = tiles_as_of(history, at_us);
  if (tiles.empty()) return std::nullopt;
  const Extent extent = extent_of(tiles);
  const std::int64_t factor = coarseness(extent, max_cells);
  const std::int64_t columns = divided_up(extent.columns(), factor);
  MapImage image{.left_m = extent.lowest.x * kTileCells * history.resolution_m(),
                 .bottom_m = extent.lowest.y * kTileCells * history.resolution_m(),
                 .cell_m = history.resolution_m() * static_cast<double>(factor),
                 .columns = static_cast<std::uint32_t>(columns),
                 .occupancy_percent = {}};
  const std::int64_t rows = divided_up(extent.rows(), factor);
  image.occupancy_percent.assign(static_cast<std::size_t>(columns * rows), -1);
  for (const auto& [index, tile] : tiles) {
    const std::array<std::int8_t, kCellsInTile> cells = inflate_tile(tile->deflated);
    const std::int64_t first_column = std::int64_t{kTileCells} * (index.x - extent.lowest.x);
    const std::int64_t first_row = std::int64_t{kTileCells} * (index.y - extent.lowest.y);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::int64_t row = (first_row + static_cast<std::int64_t>(i / kTileCells)) / factor;
      const std::int64_t column = (first_column + static_cast<std::int64_t>(i % kTileCells)) / factor;
      std::int8_t& cell = image.occupancy_percent[static_cast<std::size_t>(row * columns + column)];
      cell = std::max(cell, cells[i]);
    }
  }
  return image;
}

std::string base64(std::span<const std::int8_t> bytes) {
  constexpr std::string_view kBase64Digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t j = 0; j < 3; ++j)
      bits = bits << 8U | (j < count ? static_cast<std::uint8_t>(bytes[i + j]) : 0U);
    for (std::size_t j = 0; j < 4; ++j)
      text += j <= count ? kBase64Digits[bits >> (18U - 6U * j) & 63U] : '=';
  }
  return text;
}

}  // namespace swiftlet

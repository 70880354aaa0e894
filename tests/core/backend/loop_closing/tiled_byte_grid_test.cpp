// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/tiled_byte_grid.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

GridGeometry grid_of(int width, int height) {
  GridGeometry geometry;
  geometry.width = width;
  geometry.height = height;
  return geometry;
}

TEST(TiledByteGrid, EqualsOnePositionAfterTheOther) {
  std::mt19937 random(83);
  for (int round = 0; round < 60; ++round) {
    const GridGeometry geometry = grid_of(random_int(random, 1, 40), random_int(random, 1, 40));
    std::vector<std::uint8_t> bytes(geometry.cell_count());
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_int(random, 0, 255));
    std::vector<CellIndex> cells(static_cast<std::size_t>(random_int(random, 0, 60)));
    for (CellIndex& cell : cells) cell = {random_int(random, -30, 60), random_int(random, -30, 60)};
    const int stride = std::array{1, 2, 8}[static_cast<std::size_t>(round % 3)];
    const int x = random_int(random, -30, 30);
    const int y = random_int(random, -30, 30);
    const TiledByteGrid grid(geometry, bytes, stride);
    const TiledByteGrid::Sums sums = grid.sums(cells, x, y);
    EXPECT_EQ(grid.sums_portable(cells, x, y), sums);
    for (int row = 0; row < TiledByteGrid::kSide; ++row) {
      for (int column = 0; column < TiledByteGrid::kSide; ++column) {
        std::uint32_t expected = 0;
        for (const CellIndex& cell : cells) {
          const CellIndex moved{cell.x + x + stride * column, cell.y + y + stride * row};
          if (geometry.contains(moved)) expected += bytes[geometry.offset(moved)];
        }
        EXPECT_EQ(sums[static_cast<std::size_t>(TiledByteGrid::kSide * row + column)], expected)
            << "row " << row << ", column " << column << ", stride " << stride;
      }
    }
  }
}

TEST(TiledByteGrid, SumsThatAreSoughtAreWholeAndTheOthersLess) {
  std::mt19937 random(84);
  int ended_early = 0;
  for (int round = 0; round < 200; ++round) {
    const GridGeometry geometry = grid_of(30, 30);
    std::vector<std::uint8_t> bytes(geometry.cell_count());
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_int(random, 0, 255));
    std::vector<CellIndex> cells(300);
    for (CellIndex& cell : cells) cell = {random_int(random, -10, 30), random_int(random, -10, 30)};
    const TiledByteGrid grid(geometry, bytes, 1);
    const TiledByteGrid::Sums whole = grid.sums(cells, 0, 0);
    const auto at_least = static_cast<std::uint32_t>(random_int(random, 0, 300 * 255));
    const TiledByteGrid::Sums sums = grid.sums(cells, 0, 0, at_least);
    EXPECT_EQ(grid.sums_portable(cells, 0, 0, at_least), sums);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (whole[i] >= at_least)
        ASSERT_EQ(sums[i], whole[i]);
      else
        ASSERT_LT(sums[i], at_least);
    }
    ended_early += sums != whole ? 1 : 0;
  }
  EXPECT_GT(ended_early, 50);
}

TEST(TiledByteGrid, ManyPointsOnFullCellsDoNotOverflow) {
  const GridGeometry geometry = grid_of(8, 8);
  const std::vector<std::uint8_t> bytes(geometry.cell_count(), 255);
  const std::vector<CellIndex> cells(1000, CellIndex{0, 0});
  for (const std::uint32_t sum : TiledByteGrid(geometry, bytes, 1).sums(cells, 0, 0)) EXPECT_EQ(sum, 255000U);
}

}  // namespace
}  // namespace swiftlet

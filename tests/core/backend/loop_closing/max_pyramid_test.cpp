// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/max_pyramid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

struct RandomGrid {
  GridGeometry geometry;
  std::vector<std::uint8_t> cells;
};

RandomGrid random_grid(std::mt19937& random, int width, int height) {
  RandomGrid grid{{{}, 0.1, width, height}, {}};
  // Half of the cells unknown, as in a submap.
  for (std::size_t i = 0; i < grid.geometry.cell_count(); ++i)
    grid.cells.push_back(static_cast<std::uint8_t>(std::max(0, random_int(random, -255, 255))));
  return grid;
}

/// Maximum over [x, x + width) x [y, y + height), by looking at each cell.
std::uint8_t max_by_looking(const RandomGrid& grid, int x, int y, int width, int height) {
  std::uint8_t most = 0;
  for (int v = y; v < y + height; ++v) {
    for (int u = x; u < x + width; ++u) {
      if (grid.geometry.contains({u, v})) most = std::max(most, grid.cells[grid.geometry.offset({u, v})]);
    }
  }
  return most;
}

TEST(MaxPyramid, SumsThatAreSoughtAreWholeAndTheOthersLess) {
  std::mt19937 random(22);
  const RandomGrid grid = random_grid(random, 30, 20);
  const MaxPyramid pyramid(grid.geometry, grid.cells, 3);
  int ended_early = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<CellIndex> cells(static_cast<std::size_t>(random_int(random, 0, 100)));
    for (CellIndex& cell : cells) cell = {random_int(random, -5, 35), random_int(random, -5, 25)};
    const int level = round % 3;
    std::uint32_t whole = 0;
    for (const CellIndex& cell : cells) whole += pyramid.max_at(level, cell.x - 2, cell.y + 1);
    const auto at_least = static_cast<std::uint32_t>(random_int(random, 0, 100 * 255));
    const std::uint32_t sum = pyramid.sum(level, cells, -2, 1, at_least);
    if (whole >= at_least)
      EXPECT_EQ(sum, whole);
    else
      EXPECT_LT(sum, at_least);
    ended_early += sum != whole ? 1 : 0;
  }
  EXPECT_GT(ended_early, 50);
}

struct GridSize {
  int width;
  int height;
};
class MaxOverGrids : public testing::TestWithParam<GridSize> {};

TEST_P(MaxOverGrids, EveryLevelHoldsTheMaximaInsideAndOutsideTheGrid) {
  constexpr int kLevels = 6;
  std::mt19937 random(21);
  const RandomGrid grid = random_grid(random, GetParam().width, GetParam().height);
  const MaxPyramid pyramid(grid.geometry, grid.cells, kLevels);
  ASSERT_EQ(pyramid.levels(), kLevels);
  for (int level = 0; level < kLevels; ++level) {
    const int side = 1 << level;
    for (int y = -side - 3; y < grid.geometry.height + 3; ++y) {
      for (int x = -side - 3; x < grid.geometry.width + 3; ++x) {
        ASSERT_EQ(pyramid.max_at(level, x, y), max_by_looking(grid, x, y, side, side))
            << "level " << level << " at " << x << ", " << y;
      }
    }
    EXPECT_EQ(pyramid.max_at(level, -100000, 0), 0);
    EXPECT_EQ(pyramid.max_at(level, 0, 100000), 0);
  }
}

TEST_P(MaxOverGrids, KernelOfEachWidthHoldsTheMaximaAroundEachCell) {
  std::mt19937 random(22);
  const RandomGrid grid = random_grid(random, GetParam().width, GetParam().height);
  for (const int width : {1, 3, 5, 7}) {
    const std::vector<std::uint8_t> out = max_kernel(grid.geometry, grid.cells, width);
    ASSERT_EQ(out.size(), grid.cells.size());
    for (int y = 0; y < grid.geometry.height; ++y) {
      for (int x = 0; x < grid.geometry.width; ++x) {
        ASSERT_EQ(out[grid.geometry.offset({x, y})],
                  max_by_looking(grid, x - width / 2, y - width / 2, width, width))
            << "width " << width << " at " << x << ", " << y;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OddSizes, MaxOverGrids,
                         testing::Values(GridSize{1, 1}, GridSize{1, 9}, GridSize{9, 1}, GridSize{13, 5},
                                         GridSize{17, 31}, GridSize{32, 32}));

TEST(MaxPyramidDeathTest, CellsThatDoNotFillTheGridAreABrokenPromise) {
  const GridGeometry geometry{{}, 0.1, 3, 2};
  EXPECT_DEATH(MaxPyramid(geometry, std::vector<std::uint8_t>(5, 0), 2), "broken promise.*fill the grid");
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/max_filter.hpp"

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

struct GridSize {
  int width;
  int height;
};
class MaxOverGrids : public testing::TestWithParam<GridSize> {};

TEST_P(MaxOverGrids, SquaresAheadHoldTheMaximaFromWhereTheyTouchTheGrid) {
  std::mt19937 random(21);
  const RandomGrid grid = random_grid(random, GetParam().width, GetParam().height);
  for (const int side : {1, 2, 8}) {
    const std::vector<std::uint8_t> maxima = max_ahead(grid.geometry, grid.cells, side);
    const int width = grid.geometry.width + side - 1;
    const int height = grid.geometry.height + side - 1;
    ASSERT_EQ(maxima.size(), static_cast<std::size_t>(width * height));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        ASSERT_EQ(maxima[static_cast<std::size_t>(y * width + x)],
                  max_by_looking(grid, x - side + 1, y - side + 1, side, side))
            << "side " << side << " at " << x << ", " << y;
      }
    }
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

TEST(MaxAheadDeathTest, CellsThatDoNotFillTheGridAreABrokenPromise) {
  const GridGeometry geometry{{}, 0.1, 3, 2};
  EXPECT_DEATH((void)max_ahead(geometry, std::vector<std::uint8_t>(5, 0), 2),
               "broken promise.*fill the grid");
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/cell_walk.hpp"

#include <gmock/gmock.h>

#include <random>
#include <vector>

namespace swiftlet {
namespace {

using testing::ElementsAre;

std::vector<CellIndex> walked(const Point2& from, const Point2& to) {
  std::vector<CellIndex> cells;
  walk_cells(from, to, [&](CellIndex cell) { cells.push_back(cell); });
  return cells;
}

/// Slow twin: whether the open square of a cell meets the segment, by clipping.
bool meets(CellIndex cell, const Point2& a, const Point2& b, double slack) {
  double low = 0.0;
  double high = 1.0;
  const auto clip = [&](double start, double delta, double from, double to) {
    if (delta == 0.0) return start > from - slack && start < to + slack;
    double t0 = (from - slack - start) / delta;
    double t1 = (to + slack - start) / delta;
    if (t0 > t1) std::swap(t0, t1);
    low = std::max(low, t0);
    high = std::min(high, t1);
    return low <= high;
  };
  return clip(a.x_m, b.x_m - a.x_m, cell.x, cell.x + 1.0) && clip(a.y_m, b.y_m - a.y_m, cell.y, cell.y + 1.0);
}

TEST(CellWalk, LeavesOutTheLastCell) {
  EXPECT_THAT(walked({0.5, 0.5}, {3.5, 0.5}), ElementsAre(CellIndex{0, 0}, CellIndex{1, 0}, CellIndex{2, 0}));
}

TEST(CellWalk, VisitsNothingWithinOneCell) { EXPECT_TRUE(walked({0.2, 0.2}, {0.9, 0.8}).empty()); }

TEST(CellWalk, RoundsDownwardsBelowZero) {
  EXPECT_THAT(walked({0.5, -0.5}, {-1.5, -0.5}), ElementsAre(CellIndex{0, -1}, CellIndex{-1, -1}));
}

TEST(CellWalk, StepsFromNeighbourToNeighbourAlongTheLine) {
  std::mt19937 generator(42);
  std::uniform_real_distribution<double> coordinate(-30.0, 30.0);
  for (int run = 0; run < 2000; ++run) {
    const Point2 from{coordinate(generator), coordinate(generator)};
    const Point2 to{coordinate(generator), coordinate(generator)};
    std::vector<CellIndex> cells = walked(from, to);
    cells.push_back(cell_of(to));
    ASSERT_EQ(cells.front(), cell_of(from));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      ASSERT_TRUE(meets(cells[i], from, to, 1e-9));
      if (i == 0) continue;
      ASSERT_EQ(std::abs(cells[i].x - cells[i - 1].x) + std::abs(cells[i].y - cells[i - 1].y), 1);
    }
  }
}

TEST(CellWalk, MissesNoCellThatTheLineCrosses) {
  std::mt19937 generator(43);
  std::uniform_real_distribution<double> coordinate(-8.0, 8.0);
  for (int run = 0; run < 300; ++run) {
    const Point2 from{coordinate(generator), coordinate(generator)};
    const Point2 to{coordinate(generator), coordinate(generator)};
    std::vector<CellIndex> cells = walked(from, to);
    cells.push_back(cell_of(to));
    for (int x = -9; x <= 9; ++x)
      for (int y = -9; y <= 9; ++y)
        if (meets({x, y}, from, to, -1e-9)) {
          ASSERT_THAT(cells, testing::Contains(CellIndex{x, y}));
        }
  }
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/geometry/grid.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

// Half a metre: cell borders are exact numbers.
constexpr GridGeometry kGrid{{-1.0, -2.0}, 0.5, 8, 6};

/// Between two points in cells.
std::vector<CellIndex> walked(const Point2& from, const Point2& to) {
  std::vector<CellIndex> cells;
  walk_ray(from, to, [&](CellIndex c) { cells.push_back(c); });
  return cells;
}

/// Whether the straight line meets the square of the cell, widened by `slack` on each side.
bool meets(const Point2& from, const Point2& to, CellIndex cell, double slack) {
  const double start[2] = {from.x_m, from.y_m};
  const double along[2] = {to.x_m - from.x_m, to.y_m - from.y_m};
  const double center[2] = {cell.x + 0.5, cell.y + 0.5};
  const double half = 0.5 + slack;
  double enters = 0.0;
  double leaves = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0.0) {
      if (std::abs(start[axis] - center[axis]) > half) return false;
      continue;
    }
    const double a = (center[axis] - half - start[axis]) / along[axis];
    const double b = (center[axis] + half - start[axis]) / along[axis];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters <= leaves;
}

/// A chain of side-by-side cells from the cell of `from` to beside the cell of `to`, each once, all met.
void expect_path_along(const Point2& from, const Point2& to) {
  std::vector<CellIndex> cells = walked(from, to);
  ASSERT_TRUE(cells.empty() || cells.front() == cell_of(from));
  EXPECT_EQ(std::count(cells.begin(), cells.end(), cell_of(to)), 0) << "the end cell is not the ray's";
  cells.push_back(cell_of(to));
  for (std::size_t i = 1; i < cells.size(); ++i) {
    EXPECT_EQ(std::abs(cells[i].x - cells[i - 1].x) + std::abs(cells[i].y - cells[i - 1].y), 1)
        << "from (" << from.x_m << ", " << from.y_m << ") to (" << to.x_m << ", " << to.y_m << ")";
  }
  for (const CellIndex& c : cells) EXPECT_TRUE(meets(from, to, c, 1e-9)) << c.x << ", " << c.y;
  EXPECT_EQ(std::set<CellIndex>(cells.begin(), cells.end()).size(), cells.size()) << "no cell twice";
}

TEST(GridGeometry, ACellHoldsItsLowerBordersAndNotItsUpper) {
  EXPECT_TRUE((kGrid.cell({-1.0, -2.0}) == CellIndex{0, 0}));
  EXPECT_TRUE((kGrid.cell({-0.5, -1.5}) == CellIndex{1, 1}));
  EXPECT_TRUE((kGrid.cell({-0.501, -1.501}) == CellIndex{0, 0}));
  EXPECT_TRUE((kGrid.cell({-1.001, -2.001}) == CellIndex{-1, -1}));
}

TEST(GridGeometry, CenterLiesInItsCell) {
  for (int y = -3; y < kGrid.height + 3; ++y) {
    for (int x = -3; x < kGrid.width + 3; ++x)
      EXPECT_TRUE((kGrid.cell(kGrid.center({x, y})) == CellIndex{x, y}));
  }
}

TEST(GridGeometry, OffsetsCountTheCellsRowByRow) {
  std::size_t expected = 0;
  for (int y = 0; y < kGrid.height; ++y) {
    for (int x = 0; x < kGrid.width; ++x) EXPECT_EQ(kGrid.offset({x, y}), expected++);
  }
  EXPECT_EQ(kGrid.cell_count(), expected);
}

TEST(GridGeometry, CellsBeyondEachBorderAreOutside) {
  EXPECT_TRUE(kGrid.contains({0, 0}));
  EXPECT_TRUE(kGrid.contains({7, 5}));
  EXPECT_FALSE(kGrid.contains({-1, 0}));
  EXPECT_FALSE(kGrid.contains({0, -1}));
  EXPECT_FALSE(kGrid.contains({8, 0}));
  EXPECT_FALSE(kGrid.contains({0, 6}));
}

TEST(GridGeometry, AroundHoldsTheBoxAndItsMarginAndLittleMore) {
  std::mt19937 random(11);
  for (int i = 0; i < 200; ++i) {
    const double resolution_m = random_in(random, 0.03, 0.4);
    const double margin_m = random_in(random, 0.0, 1.0);
    const Point2 low{random_in(random, -20.0, 20.0), random_in(random, -20.0, 20.0)};
    const Point2 high{low.x_m + random_in(random, 0.0, 9.0), low.y_m + random_in(random, 0.0, 9.0)};
    const GridGeometry g = GridGeometry::around(low, high, margin_m, resolution_m);
    EXPECT_TRUE(g.contains(g.cell({low.x_m - margin_m + 1e-9, low.y_m - margin_m + 1e-9})));
    EXPECT_TRUE(g.contains(g.cell({high.x_m + margin_m, high.y_m + margin_m})));
    EXPECT_LE(g.width * resolution_m, high.x_m - low.x_m + 2.0 * margin_m + 3.0 * resolution_m);
    EXPECT_LE(g.height * resolution_m, high.y_m - low.y_m + 2.0 * margin_m + 3.0 * resolution_m);
  }
}

TEST(CellOf, RoundsDownwardsBelowZero) {
  EXPECT_EQ(cell_of({-0.1, -1.0}), (CellIndex{-1, -1}));
  EXPECT_EQ(cell_of({-0.1, 0.7}, 0.5), (CellIndex{-1, 1}));
}

TEST(FloorToInt, IsTheFloorOnBothSidesOfIntegersAndAtTheEndsOfTheRange) {
  for (const double value :
       {-2147483648.0, -3.5, -1.0, -0.5, -0.0, 0.0, 0.5, 1.0, 7.25, 2147483647.0, 2147483647.5}) {
    for (const double near : {std::max(-2147483648.0, std::nextafter(value, -HUGE_VAL)), value,
                              std::min(2147483647.75, std::nextafter(value, HUGE_VAL))})
      EXPECT_EQ(floor_to_int(near), static_cast<std::int32_t>(std::floor(near))) << near;
  }
}

TEST(WalkRay, LeavesOutTheLastCell) {
  EXPECT_THAT(walked({0.5, 0.5}, {3.5, 0.5}), ElementsAre(CellIndex{0, 0}, CellIndex{1, 0}, CellIndex{2, 0}));
  EXPECT_THAT(walked({0.5, -0.5}, {-1.5, -0.5}), ElementsAre(CellIndex{0, -1}, CellIndex{-1, -1}));
}

TEST(WalkRay, VisitsNothingWithinOneCell) {
  EXPECT_THAT(walked({0.1, 0.1}, {0.1, 0.1}), IsEmpty());
  EXPECT_THAT(walked({0.2, 0.2}, {0.9, 0.8}), IsEmpty());
}

TEST(WalkRay, MissesNoCellThatARandomRayCrosses) {
  std::mt19937 random(12);
  for (int i = 0; i < 500; ++i) {
    const Point2 from{random_in(random, -8.0, 8.0), random_in(random, -8.0, 8.0)};
    const Point2 to{random_in(random, -8.0, 8.0), random_in(random, -8.0, 8.0)};
    expect_path_along(from, to);
    std::vector<CellIndex> cells = walked(from, to);
    cells.push_back(cell_of(to));
    for (int x = -9; x <= 9; ++x)
      for (int y = -9; y <= 9; ++y)
        if (meets(from, to, {x, y}, -1e-9)) {
          ASSERT_THAT(cells, Contains(CellIndex{x, y}));
        }
  }
}

TEST(WalkRay, RaysThroughExactCornersStayBesideTheLine) {
  std::mt19937 random(13);
  for (int i = 0; i < 2000; ++i) {
    // On borders, corners and centres.
    const Point2 from{0.5 * random_int(random, -12, 20), 0.5 * random_int(random, -16, 12)};
    const Point2 to{0.5 * random_int(random, -12, 20), 0.5 * random_int(random, -16, 12)};
    expect_path_along(from, to);
  }
}

TEST(WalkRay, AxisParallelRaysVisitTheirRowOrColumn) {
  for (const double end : {4.5, -5.5}) {
    const std::vector<CellIndex> row = walked({0.5, 0.5}, {end, 0.5});
    EXPECT_EQ(row.size(), static_cast<std::size_t>(std::abs(end - 0.5)));
    for (const CellIndex& c : row) EXPECT_EQ(c.y, 0);
    const std::vector<CellIndex> column = walked({0.5, 0.5}, {0.5, end});
    EXPECT_EQ(column.size(), static_cast<std::size_t>(std::abs(end - 0.5)));
    for (const CellIndex& c : column) EXPECT_EQ(c.x, 0);
  }
}

TEST(WalkRay, ARayAlongABorderOfAGridStaysInItsRow) {
  // A hair below the border, which the row's number rounds away.
  const double below_m = std::nextafter(14.5, 0.0);
  ASSERT_EQ(kGrid.cell({3.75, below_m}).y, 33);
  EXPECT_THAT(walked(kGrid.in_cells({2.75, 14.5}), kGrid.in_cells({3.75, below_m})),
              ElementsAre(CellIndex{7, 33}, CellIndex{8, 33}));
}

TEST(WalkRay, ARayThatEndsOnTheBorderItComesFromKeepsItsRow) {
  // Downwards, yet both ends lie in row 1: rounding must not step into row 0 at once.
  const double above = std::nextafter(1.0, 2.0);
  EXPECT_THAT(walked({0.5, above}, {2.5, 1.0}), ElementsAre(CellIndex{0, 1}, CellIndex{1, 1}));
}

}  // namespace
}  // namespace swiftlet

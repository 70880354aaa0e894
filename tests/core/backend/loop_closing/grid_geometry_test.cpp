// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/grid_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "tests/support/random_draws.hpp"

namespace swiftlet {

static bool operator==(const CellIndex& a, const CellIndex& b) { return a.x == b.x && a.y == b.y; }
static bool operator<(const CellIndex& a, const CellIndex& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }

namespace {

// Half a metre: cell borders are exact numbers.
constexpr GridGeometry kGrid{{-1.0, -2.0}, 0.5, 8, 6};

std::vector<CellIndex> walked(const GridGeometry& grid, const Point2& from, const Point2& to) {
  std::vector<CellIndex> cells;
  walk_ray(grid, from, to, [&](CellIndex c) { cells.push_back(c); });
  return cells;
}

/// Whether the straight line comes within rounding of the closed square of the cell.
bool touches(const GridGeometry& grid, const Point2& from, const Point2& to, CellIndex cell) {
  constexpr double kRounding = 1e-9;
  const double start[2] = {from.x_m, from.y_m};
  const double along[2] = {to.x_m - from.x_m, to.y_m - from.y_m};
  const Point2 middle = grid.center(cell);
  const double center[2] = {middle.x_m, middle.y_m};
  const double half = 0.5 * grid.resolution_m + kRounding;
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

/// A chain of side-by-side cells from the cell of `from` to beside the cell of `to`, each once, all touched.
void expect_path_along(const GridGeometry& grid, const Point2& from, const Point2& to) {
  std::vector<CellIndex> cells = walked(grid, from, to);
  ASSERT_TRUE(cells.empty() || cells.front() == grid.cell(from));
  const CellIndex end = grid.cell(to);
  EXPECT_EQ(std::count(cells.begin(), cells.end(), end), 0) << "the end cell is not the ray's";
  cells.push_back(end);
  for (std::size_t i = 1; i < cells.size(); ++i) {
    EXPECT_EQ(std::abs(cells[i].x - cells[i - 1].x) + std::abs(cells[i].y - cells[i - 1].y), 1)
        << "from (" << from.x_m << ", " << from.y_m << ") to (" << to.x_m << ", " << to.y_m << ")";
  }
  for (const CellIndex& c : cells) EXPECT_TRUE(touches(grid, from, to, c)) << c.x << ", " << c.y;
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

TEST(WalkRay, RandomRaysVisitWhatDenseSamplingFinds) {
  constexpr int kSamples = 2000;
  std::mt19937 random(12);
  for (int i = 0; i < 500; ++i) {
    const Point2 from{random_in(random, -3.0, 5.0), random_in(random, -4.0, 3.0)};
    const Point2 to{random_in(random, -3.0, 5.0), random_in(random, -4.0, 3.0)};
    expect_path_along(kGrid, from, to);
    const std::vector<CellIndex> cells = walked(kGrid, from, to);
    const std::set<CellIndex> visited(cells.begin(), cells.end());
    for (int k = 0; k <= kSamples; ++k) {
      const double t = static_cast<double>(k) / kSamples;
      const CellIndex c =
          kGrid.cell({from.x_m + t * (to.x_m - from.x_m), from.y_m + t * (to.y_m - from.y_m)});
      EXPECT_TRUE(c == kGrid.cell(to) || visited.contains(c)) << c.x << ", " << c.y;
    }
  }
}

TEST(WalkRay, RaysThroughExactCornersStayBesideTheLine) {
  std::mt19937 random(13);
  for (int i = 0; i < 2000; ++i) {
    // On borders, corners and centres.
    const Point2 from{0.25 * random_int(random, -12, 20), 0.25 * random_int(random, -16, 12)};
    const Point2 to{0.25 * random_int(random, -12, 20), 0.25 * random_int(random, -16, 12)};
    expect_path_along(kGrid, from, to);
  }
}

TEST(WalkRay, ARayWithinOneCellVisitsNothing) {
  EXPECT_TRUE(walked(kGrid, {0.1, 0.1}, {0.1, 0.1}).empty());
  EXPECT_TRUE(walked(kGrid, {0.1, 0.1}, {0.4, 0.3}).empty());
}

TEST(WalkRay, AxisParallelRaysVisitTheirRowOrColumn) {
  for (const double x_m : {2.25, -2.75}) {
    const std::vector<CellIndex> row = walked(kGrid, {0.25, 0.25}, {x_m, 0.25});
    EXPECT_EQ(row.size(), static_cast<std::size_t>(std::abs(x_m - 0.25) / 0.5));
    for (const CellIndex& c : row) EXPECT_EQ(c.y, kGrid.cell({0.0, 0.25}).y);
  }
  for (const double y_m : {1.75, -3.75}) {
    const std::vector<CellIndex> column = walked(kGrid, {0.25, 0.25}, {0.25, y_m});
    EXPECT_EQ(column.size(), static_cast<std::size_t>(std::abs(y_m - 0.25) / 0.5));
    for (const CellIndex& c : column) EXPECT_EQ(c.x, kGrid.cell({0.25, 0.0}).x);
  }
}

TEST(WalkRay, VisitsCellsOutsideTheGridToo) {
  const std::vector<CellIndex> cells = walked(kGrid, {-3.0, -5.0}, {-2.1, -5.0});
  ASSERT_EQ(cells.size(), 1U);
  EXPECT_TRUE((cells[0] == CellIndex{-4, -6}));
}

}  // namespace
}  // namespace swiftlet

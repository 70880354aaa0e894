// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/free_space_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace swiftlet {
namespace {

constexpr double kCellM = 0.15;
constexpr double kFarM = 1.2;          // clearance beyond this is all the same
constexpr double kComfortableM = 0.8;  // nearer to a wall, a way costs more
constexpr double kNearnessCost = 6.0;  // its weight
constexpr double kFlownCost = 4.0;     // of a way that was flown before
constexpr double kFlownM = 1.0;        // to either side of it
constexpr double kGivenUpM = 0.04;  // clearance that a straight line may lose against the cells it replaces

struct Step {
  int columns;
  int rows;
  double length;
};
constexpr double kDiagonal = 1.4142135623730951;
constexpr std::array<Step, 8> kSteps{{{1, 0, 1.0},
                                      {0, 1, 1.0},
                                      {-1, 0, 1.0},
                                      {0, -1, 1.0},
                                      {1, 1, kDiagonal},
                                      {-1, 1, kDiagonal},
                                      {-1, -1, kDiagonal},
                                      {1, -1, kDiagonal}}};

double price(double clearance_m) {
  const double short_m = std::max(0.0, kComfortableM - clearance_m);
  return 1.0 + kNearnessCost * short_m * short_m;
}

}  // namespace

FreeSpaceGrid::FreeSpaceGrid(const BuildingPlan& plan) {
  set_bounds(plan.areas());
  mark(plan.areas(), kFarM);
  mark(plan.obstacles(), 0.0);
  mark(plan.kept_out(), 0.0);
  for (const WallSegment& wall : plan.walls()) lower(wall);
  keep_largest_part();
  is_flown_.resize(clearance_m_.size(), false);
  reached_.resize(clearance_m_.size());
}

void FreeSpaceGrid::set_bounds(const std::vector<Outline>& areas) {
  Point2 low = areas.front().front();
  Point2 high = low;
  for (const Outline& area : areas) {
    for (const Point2& corner : area) {
      low = {std::min(low.x_m, corner.x_m), std::min(low.y_m, corner.y_m)};
      high = {std::max(high.x_m, corner.x_m), std::max(high.y_m, corner.y_m)};
    }
  }
  origin_ = {low.x_m - kCellM, low.y_m - kCellM};
  columns_ = static_cast<int>((high.x_m - origin_.x_m) / kCellM) + 2;
  rows_ = static_cast<int>((high.y_m - origin_.y_m) / kCellM) + 2;
  clearance_m_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0);
}

template <typename Visit>
void FreeSpaceGrid::for_cells_between(const Point2& low, const Point2& high, const Visit& visit) {
  const auto column = [this](double x_m) {
    return std::clamp(static_cast<int>((x_m - origin_.x_m) / kCellM), 0, columns_ - 1);
  };
  const auto row = [this](double y_m) {
    return std::clamp(static_cast<int>((y_m - origin_.y_m) / kCellM), 0, rows_ - 1);
  };
  for (int r = row(low.y_m); r <= row(high.y_m); ++r)
    for (int c = column(low.x_m); c <= column(high.x_m); ++c) visit(Cell{r * columns_ + c});
}

void FreeSpaceGrid::mark(const std::vector<Outline>& areas, double clearance) {
  for (const Outline& area : areas) {
    const auto [left, right] = std::ranges::minmax(area, {}, &Point2::x_m);
    const auto [low, high] = std::ranges::minmax(area, {}, &Point2::y_m);
    for_cells_between({left.x_m, low.y_m}, {right.x_m, high.y_m}, [&](Cell cell) {
      if (contains(area, centre(cell))) clearance_m_[static_cast<std::size_t>(cell)] = clearance;
    });
  }
}

void FreeSpaceGrid::lower(const WallSegment& wall) {
  const Point2 low{std::min(wall.start.x_m, wall.end.x_m) - kFarM,
                   std::min(wall.start.y_m, wall.end.y_m) - kFarM};
  const Point2 high{std::max(wall.start.x_m, wall.end.x_m) + kFarM,
                    std::max(wall.start.y_m, wall.end.y_m) + kFarM};
  for_cells_between(low, high, [&](Cell cell) {
    double& clearance = clearance_m_[static_cast<std::size_t>(cell)];
    if (clearance > 0.0) clearance = std::min(clearance, distance_m(wall, centre(cell)));
  });
}

std::optional<FreeSpaceGrid::Cell> FreeSpaceGrid::cell_at(const Point2& point) const {
  const double column = std::floor((point.x_m - origin_.x_m) / kCellM);
  const double row = std::floor((point.y_m - origin_.y_m) / kCellM);
  if (column < 0.0 || row < 0.0 || column >= columns_ || row >= rows_) return std::nullopt;
  return static_cast<Cell>(row) * columns_ + static_cast<Cell>(column);
}

Point2 FreeSpaceGrid::centre(Cell cell) const {
  const Cell column = cell % columns_;
  const Cell row = cell / columns_;
  return {origin_.x_m + kCellM * (column + 0.5), origin_.y_m + kCellM * (row + 0.5)};
}

double FreeSpaceGrid::clearance_m(const Point2& point) const {
  const std::optional<Cell> cell = cell_at(point);
  return cell ? clearance_m_[static_cast<std::size_t>(*cell)] : 0.0;
}

bool FreeSpaceGrid::is_free(Cell cell) const {
  return clearance_m_[static_cast<std::size_t>(cell)] >= kMarginM;
}

/// All other parts count as walled in from then on.
void FreeSpaceGrid::keep_largest_part() {
  std::vector<Cell> largest;
  std::vector<bool> is_known(clearance_m_.size(), false);
  for (Cell cell = 0; cell < static_cast<Cell>(clearance_m_.size()); ++cell) {
    if (is_known[static_cast<std::size_t>(cell)] || !is_free(cell)) continue;
    std::vector<Cell> part = part_around(cell, is_known);
    if (part.size() > largest.size()) largest = std::move(part);
  }
  std::vector<double> kept(clearance_m_.size(), 0.0);
  for (const Cell cell : largest) {
    kept[static_cast<std::size_t>(cell)] = clearance_m_[static_cast<std::size_t>(cell)];
    places_.push_back(centre(cell));
  }
  clearance_m_ = std::move(kept);
}

std::vector<FreeSpaceGrid::Cell> FreeSpaceGrid::part_around(Cell seed, std::vector<bool>& is_known) const {
  std::vector<Cell> part{seed};
  is_known[static_cast<std::size_t>(seed)] = true;
  for (std::size_t i = 0; i < part.size(); ++i) {
    for (std::size_t side = 0; side < 4; ++side) {  // the grid ends in cells that are not free
      const Cell next = part[i] + kSteps[side].rows * columns_ + kSteps[side].columns;
      if (is_known[static_cast<std::size_t>(next)] || !is_free(next)) continue;
      is_known[static_cast<std::size_t>(next)] = true;
      part.push_back(next);
    }
  }
  return part;
}

std::optional<std::vector<Point2>> FreeSpaceGrid::route(const Point2& from, const Point2& to,
                                                        bool avoids_flown) {
  const std::optional<Cell> start = cell_at(from);
  const std::optional<Cell> end = cell_at(to);
  if (!start || !end || !is_free(*start) || !is_free(*end) || !search(*start, *end, avoids_flown))
    return std::nullopt;
  std::vector<Cell> cells{*end};
  while (cells.back() != *start) cells.push_back(reached_[static_cast<std::size_t>(cells.back())].before);
  std::ranges::reverse(cells);
  return corners(cells);
}

void FreeSpaceGrid::mark_flown(const Point2& from, const Point2& to) {
  const WallSegment line{from, to};
  const Point2 low{std::min(from.x_m, to.x_m) - kFlownM, std::min(from.y_m, to.y_m) - kFlownM};
  const Point2 high{std::max(from.x_m, to.x_m) + kFlownM, std::max(from.y_m, to.y_m) + kFlownM};
  for_cells_between(low, high, [&](Cell cell) {
    if (distance_m(line, centre(cell)) < kFlownM) is_flown_[static_cast<std::size_t>(cell)] = true;
  });
}

bool FreeSpaceGrid::search(Cell from, Cell to, bool avoids_flown) {
  using Candidate = std::pair<double, Cell>;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> open;
  const int search = ++searches_;
  const auto left = [&](Cell cell) { return distance_m(centre(cell), centre(to)) / kCellM; };
  reached_[static_cast<std::size_t>(from)] = {.way = 0.0, .before = from, .search = search};
  open.emplace(left(from), from);
  while (!open.empty()) {
    const Cell cell = open.top().second;
    open.pop();
    if (cell == to) return true;
    Reached& here = reached_[static_cast<std::size_t>(cell)];
    if (std::exchange(here.is_done, true)) continue;
    for (const Step& step : kSteps) {
      const Cell next = cell + step.rows * columns_ + step.columns;
      if (!is_free(next)) continue;
      Reached& there = reached_[static_cast<std::size_t>(next)];
      const double again = avoids_flown && is_flown_[static_cast<std::size_t>(next)] ? kFlownCost : 1.0;
      const double way = here.way + again * step.length * price(clearance_m_[static_cast<std::size_t>(next)]);
      if (there.search == search && there.way <= way) continue;
      there = {.way = way, .before = cell, .search = search};
      open.emplace(way + left(next), next);
    }
  }
  return false;
}

/// The fewest straight lines that come no nearer to a wall than the cells.
std::vector<Point2> FreeSpaceGrid::corners(const std::vector<Cell>& cells) const {
  std::vector<Point2> line{centre(cells.front())};
  std::size_t at = 0;
  while (at + 1 < cells.size()) {
    double min_m = clearance_m(centre(cells[at]));
    std::size_t next = at + 1;
    for (std::size_t i = at + 1; i < cells.size(); ++i) {
      min_m = std::min({min_m, clearance_m(centre(cells[i])), kComfortableM});
      if (min_clearance_m(centre(cells[at]), centre(cells[i])) < std::max(kMarginM, min_m - kGivenUpM)) break;
      next = i;
    }
    line.push_back(centre(cells[next]));
    at = next;
  }
  return line;
}

double FreeSpaceGrid::min_clearance_m(const Point2& from, const Point2& to) const {
  const int samples = 1 + static_cast<int>(distance_m(from, to) / (kCellM / 2.0));
  double min_m = kFarM;
  for (int i = 0; i <= samples; ++i) {
    const double share = static_cast<double>(i) / samples;
    min_m = std::min(
        min_m, clearance_m({from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m)}));
  }
  return min_m;
}

}  // namespace swiftlet

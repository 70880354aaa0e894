// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "firmware_link/simulation/building_plan.hpp"

namespace swiftlet {

/// Where in a building the vehicle can be flown: the largest connected part of it that keeps a distance to
/// walls and obstacles, in cells. One thread at a time; allocates.
class FreeSpaceGrid {
 public:
  /// A vehicle that wanders about its way and cuts corners.
  static constexpr double kMarginM = 0.36;

  explicit FreeSpaceGrid(const BuildingPlan& plan);

  /// The centres of all cells that can be reached from each other.
  [[nodiscard]] const std::vector<Point2>& places() const { return places_; }
  /// To the next wall, up to 1.2 m; 0 outside and in obstacles.
  [[nodiscard]] double clearance_m(const Point2& point) const;
  /// The corners of a way between two places, both included, that prefers the middle of the free space (A*),
  /// and where asked what was not flown before. nullopt: one of them is no place.
  [[nodiscard]] std::optional<std::vector<Point2>> route(const Point2& from, const Point2& to,
                                                         bool avoids_flown);
  void mark_flown(const Point2& from, const Point2& to);

 private:
  using Cell = std::int32_t;
  struct Reached {
    double way = 0.0;  // weighted by nearness to walls
    Cell before = 0;
    int search = 0;  // of which search this is
    bool is_done = false;
  };

  [[nodiscard]] std::optional<Cell> cell_at(const Point2& point) const;
  [[nodiscard]] Point2 centre(Cell cell) const;
  [[nodiscard]] bool is_free(Cell cell) const;
  void set_bounds(const std::vector<Outline>& areas);
  template <typename Visit>
  void for_cells_between(const Point2& low, const Point2& high, const Visit& visit);
  void mark(const std::vector<Outline>& areas, double clearance);
  void lower(const WallSegment& wall);
  void keep_largest_part();
  [[nodiscard]] std::vector<Cell> part_around(Cell seed, std::vector<bool>& is_known) const;
  [[nodiscard]] bool search(Cell from, Cell to, bool avoids_flown);
  [[nodiscard]] std::vector<Point2> corners(const std::vector<Cell>& cells) const;
  [[nodiscard]] double min_clearance_m(const Point2& from, const Point2& to) const;

  Point2 origin_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<double> clearance_m_;
  std::vector<bool> is_flown_;
  std::vector<Point2> places_;
  std::vector<Reached> reached_;
  int searches_ = 0;
};

}  // namespace swiftlet

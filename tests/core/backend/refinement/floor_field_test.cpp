// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/floor_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace swiftlet {
namespace {

constexpr StoreyId kGroundFloor{};
constexpr auto kFloorAbove = StoreyId{1};

/// Along a row of cells, two nodes in each, and back over the same ones.
std::vector<PlaceOnFloor> there_and_back() {
  const double quarter_m = 0.5 * FloorFieldTuning().cell_m;
  std::vector<PlaceOnFloor> nodes;
  nodes.reserve(16);
  for (int k = 0; k < 8; ++k) nodes.push_back({{quarter_m * (k + 0.4), 0.3}, kGroundFloor});
  for (int k = 7; k >= 0; --k) nodes.push_back({{quarter_m * (k + 0.4), 0.6}, kGroundFloor});
  return nodes;
}

TEST(FloorField, PassagesShareACell) {
  FloorField floor{FloorFieldTuning()};
  floor.place(there_and_back());
  EXPECT_EQ(floor.size(), 4U);
  for (std::size_t k = 1; k < 8; ++k) EXPECT_EQ(floor.cell_of(k), floor.cell_of(16 - k)) << k;
  EXPECT_NE(floor.cell_of(1), floor.cell_of(7));
}

TEST(FloorField, StoreysHaveFloorsOfTheirOwn) {
  FloorField floor{FloorFieldTuning()};
  floor.place(std::vector<PlaceOnFloor>{
      {{0.3, 0.3}, kGroundFloor}, {{0.6, 0.3}, kGroundFloor}, {{0.3, 0.3}, kFloorAbove}});
  EXPECT_NE(floor.cell_of(1), floor.cell_of(2));
}

TEST(FloorField, CellsKeepTheirErrorsWhenTheNodesMove) {
  FloorField floor{FloorFieldTuning()};
  floor.place(there_and_back());
  const std::size_t cell = floor.cell_of(7);
  floor.change(cell, 0.4);
  std::vector<PlaceOnFloor> moved = there_and_back();
  for (PlaceOnFloor& node : moved) node.p_map.y_m += FloorFieldTuning().cell_m;
  floor.place(moved);
  EXPECT_EQ(floor.error(floor.cell_of(7)), 0.0);
  floor.place(there_and_back());
  EXPECT_EQ(floor.cell_of(7), cell);
  EXPECT_EQ(floor.error(cell), 0.4);
}

TEST(FloorField, ThePriorsWeightHasTheSlopeOfItsCost) {
  for (const double error : {0.0, 0.05, 0.3, 1.0}) {
    FloorField floor{FloorFieldTuning()};
    floor.place(std::vector<PlaceOnFloor>(2));
    floor.change(0, error);
    const double slope = floor.information(0) * error;
    const double cost = floor.cost();
    floor.change(0, 1e-6);
    EXPECT_NEAR((floor.cost() - cost) / 1e-6, slope, 1e-3) << error;
  }
}

TEST(FloorField, ManySmallErrorsCostLessThanOneGreatOne) {
  FloorField small{FloorFieldTuning()};
  small.place(there_and_back());
  for (std::size_t cell = 0; cell < small.size(); ++cell) small.change(cell, 0.03);
  FloorField great{FloorFieldTuning()};
  great.place(there_and_back());
  great.change(2, 0.5);
  EXPECT_LT(small.cost(), 0.5);
  EXPECT_GT(great.cost(), FloorFieldTuning().min_cost);
}

TEST(FloorField, NoStepLeadsBeyondWhatASensorCanDo) {
  FloorField floor{FloorFieldTuning()};
  floor.place(std::vector<PlaceOnFloor>(2));
  floor.change(0, -3.0);
  EXPECT_GT(1.0 + floor.error(0), 0.3);
  floor.change(0, 30.0);
  EXPECT_LT(1.0 + floor.error(0), 3.0);
}

}  // namespace
}  // namespace swiftlet

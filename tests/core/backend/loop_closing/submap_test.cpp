// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/submap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/backend/loop_closing/max_filter.hpp"
#include "tests/support/stored_run.hpp"
#include "tests/support/test_vehicle.hpp"
#include "tests/support/text_room.hpp"

namespace swiftlet {
namespace {

// Blocks of half a metre. The corner lies so that no wall falls on the border of two map cells.
const std::vector<std::string> kRoomPicture{"############",  //
                                            "#..........#",  //
                                            "#..........#",  //
                                            "#.a......b.#",  //
                                            "#......##..#",  //
                                            "#......##..#",  //
                                            "#.d......c.#",  //
                                            "#..........#",  //
                                            "############"};
constexpr double kBlockM = 0.5;
const Point2 kRoomCorner{-1.3, -2.8};
constexpr std::uint8_t kEven = 128;  // neither occupied nor free

TestVehicleModel exact_vehicle() {
  TestVehicleModel model;
  model.range_sigma_m = 0.0;
  return model;
}

/// Once around the room, with no errors at all: the odometry's frame is the world as seen from the start.
class SubmapTest : public testing::Test {
 protected:
  SubmapTest() {
    for (const char place : {'b', 'c', 'd', 'a'}) vehicle_.fly_to(room_, room_.place(place));
  }
  /// Without the kernel unless asked for, so that a cell shows what was drawn in it.
  [[nodiscard]] static Submap build(const StoredRun& run, KeyframeId first, KeyframeId last,
                                    int kernel_cells = 1) {
    BackendConfig config;
    config.max_kernel_cells = kernel_cells;
    return build_submap(first, last, run.scans(), run.chain(), run.T_local_keyframe(), config);
  }
  [[nodiscard]] Pose2 T_world_submap(const StoredRun& run, const Submap& submap) const {
    return start_ * run.T_local_keyframe()[submap.reference];
  }

  TextRoom room_{kRoomPicture, kBlockM, kRoomCorner};
  Pose2 start_{room_.place('a').x_m, room_.place('a').y_m, 0.0};
  TestVehicle vehicle_{room_, start_, exact_vehicle(), 1};
};

std::uint8_t occupied_at(const Submap& submap, const Point2& p_submap) {
  const GridGeometry& grid = submap.geometry;
  const CellIndex c = grid.cell(p_submap);
  return grid.contains(c) ? submap.cells[grid.offset(c)] : 0;
}

TEST_F(SubmapTest, ItsFrameIsTheKeyframeInTheMiddle) {
  const StoredRun run(vehicle_.samples());
  const Submap submap = build(run, KeyframeId{4}, KeyframeId{10});
  EXPECT_EQ(submap.scans, run.chain().scans_of({KeyframeId{4}, KeyframeId{10}}));
  EXPECT_EQ(submap.end_path_m, run.chain().path_m(KeyframeId{10}));
  EXPECT_EQ(submap.reference, KeyframeId{7});
}

TEST_F(SubmapTest, EveryHitMakesAnOccupiedCellAndEveryOccupiedCellHasAWall) {
  const StoredRun run(vehicle_.samples());
  const Submap submap = build(run, KeyframeId{0}, run.newest());
  const Pose2 T_world_to_submap = T_world_submap(run, submap).inverse();
  const std::vector<std::uint8_t> occupied = submap.cells;
  std::vector<std::uint8_t> is_hit(occupied.size(), 0);
  const GridGeometry& grid = submap.geometry;
  std::size_t hits = 0;
  std::size_t high = 0;
  for (ScanId i{}; i < run.chain().scan_of(run.newest()); ++i) {
    for (const ScanReturn& beam : run.scans().returns(i)) {
      if (!beam.is_hit) continue;
      const Point2 p =
          T_world_to_submap * (start_ * run.scans()[i].T_odom_body) * run.scans().point_body(beam);
      is_hit[grid.offset(grid.cell(p))] = 1;
      ++hits;
      high += occupied_at(submap, p) > kEven;
    }
  }
  EXPECT_GT(static_cast<double>(high), 0.95 * static_cast<double>(hits))
      << "a grazing beam may win here or there";
  for (std::size_t k = 0; k < occupied.size(); ++k) {
    EXPECT_TRUE(occupied[k] <= kEven || is_hit[k] == 1) << "cell " << k;
  }
}

TEST_F(SubmapTest, FlownThroughSpaceIsFreeAndSolidWallUnknown) {
  const StoredRun run(vehicle_.samples());
  const Submap submap = build(run, KeyframeId{0}, run.newest());
  const Pose2 T_submap_world = T_world_submap(run, submap).inverse();
  for (ScanId i{}; i < run.chain().scan_of(run.newest()); ++i) {
    const std::uint8_t value =
        occupied_at(submap, T_submap_world * (start_ * run.scans()[i].T_odom_body).position());
    EXPECT_GT(value, 0) << "scan " << index_of(i);
    EXPECT_LT(value, kEven) << "scan " << index_of(i);
  }
  // The middle of the pillar, which no beam can reach.
  const Point2 pillar{kRoomCorner.x_m + 8.0 * kBlockM, kRoomCorner.y_m + 4.0 * kBlockM};
  EXPECT_EQ(occupied_at(submap, T_submap_world * pillar), 0);
}

TEST_F(SubmapTest, NothingIsKnownOutsideTheRoom) {
  const StoredRun run(vehicle_.samples());
  const Submap submap = build(run, KeyframeId{0}, run.newest());
  const Pose2 T_world = T_world_submap(run, submap);
  const GridGeometry& grid = submap.geometry;
  const double width_m = static_cast<double>(kRoomPicture[0].size()) * kBlockM;
  const double height_m = static_cast<double>(kRoomPicture.size()) * kBlockM;
  const double wall_m = kBlockM - 2.0 * grid.resolution_m;  // its face may stain the cells beside it
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const Point2 p = T_world * grid.center({x, y});
      const bool inside = p.x_m > kRoomCorner.x_m + wall_m && p.x_m < kRoomCorner.x_m + width_m - wall_m &&
                          p.y_m > kRoomCorner.y_m + wall_m && p.y_m < kRoomCorner.y_m + height_m - wall_m;
      EXPECT_TRUE(inside || submap.cells[grid.offset({x, y})] == 0) << p.x_m << ", " << p.y_m;
    }
  }
}

TEST_F(SubmapTest, TheBoxHoldsTheHitsTightly) {
  const StoredRun run(vehicle_.samples());
  // The first straight flight sees the wall ahead and the walls on both sides.
  const Submap submap = build(run, KeyframeId{0}, KeyframeId{4});
  const Pose2 T_world = T_world_submap(run, submap);
  const Point2 low = T_world * submap.low_m;
  const Point2 high = T_world * submap.high_m;
  EXPECT_NEAR(low.x_m, kRoomCorner.x_m + kBlockM, 1e-6) << "the wall behind";
  EXPECT_NEAR(low.y_m, kRoomCorner.y_m + kBlockM, 1e-6);
  EXPECT_NEAR(high.y_m, kRoomCorner.y_m + 8.0 * kBlockM, 1e-6);
}

TEST_F(SubmapTest, TheKernelIsAppliedToTheGrid) {
  const StoredRun run(vehicle_.samples());
  const Submap plain = build(run, KeyframeId{0}, run.newest());
  const Submap kernelled = build(run, KeyframeId{0}, run.newest(), 3);
  EXPECT_EQ(kernelled.cells, max_kernel(plain.geometry, plain.cells, 3));
}

TEST_F(SubmapTest, HoldsOnlyTheScansOfItsStretch) {
  const StoredRun run(vehicle_.samples());
  const Submap all = build(run, KeyframeId{0}, run.newest());
  const Submap beginning = build(run, KeyframeId{0}, KeyframeId{4});
  // The far corner by 'd', seen on the way home only.
  const Point2 corner{kRoomCorner.x_m + kBlockM - 0.01, room_.place('d').y_m};
  EXPECT_GT(occupied_at(all, T_world_submap(run, all).inverse() * corner), kEven);
  EXPECT_EQ(occupied_at(beginning, T_world_submap(run, beginning).inverse() * corner), 0);
}

TEST_F(SubmapTest, ABeamThatMeetsNothingSaysNothing) {
  TestVehicleModel model = exact_vehicle();
  model.max_range_m = 0.2;  // no wall is as near on the way to b
  TestVehicle blind(room_, start_, model, 1);
  blind.fly_to(room_, room_.place('b'));
  const StoredRun run(blind.samples());
  const Submap submap = build(run, KeyframeId{0}, run.newest());
  const std::vector<std::uint8_t> occupied = submap.cells;
  EXPECT_EQ(*std::max_element(occupied.begin(), occupied.end()), 0);
}

}  // namespace
}  // namespace swiftlet

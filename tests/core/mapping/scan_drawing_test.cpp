// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/scan_drawing.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace swiftlet {
namespace {

/// The lower left corner of the map, rows from the top: '#' more occupied than not, '.' free, ' ' unknown.
std::vector<std::string> picture(const TileStore& store, std::size_t width, std::size_t height) {
  const MapTile tile = store.tile({0, 0});
  std::vector<std::string> rows;
  for (std::size_t y = height; y-- > 0;) {
    std::string row;
    for (std::size_t x = 0; x < width; ++x) {
      const std::int8_t percent = tile.occupancy_percent[y * kTileCells + x];
      row += percent < 0 ? ' ' : percent > 50 ? '#' : '.';
    }
    rows.push_back(row);
  }
  return rows;
}

MapConfig metre_cells() { return {.resolution_m = 1.0}; }

std::vector<MapTile> all_tiles(ScanDrawing& drawing) {
  drawing.store().publish();
  std::vector<MapTile> tiles;
  for (const TileIndex index : drawing.store().tiles()) tiles.push_back(drawing.store().tile(index));
  return tiles;
}

void expect_same_map(ScanDrawing& a, ScanDrawing& b) {
  const std::vector<MapTile> tiles_a = all_tiles(a);
  const std::vector<MapTile> tiles_b = all_tiles(b);
  ASSERT_EQ(tiles_a.size(), tiles_b.size());
  for (std::size_t i = 0; i < tiles_a.size(); ++i) {
    EXPECT_EQ(tiles_a[i].index, tiles_b[i].index);
    EXPECT_EQ(tiles_a[i].occupancy_percent, tiles_b[i].occupancy_percent);
  }
}

struct Scan {
  Pose2 T_map_body;
  std::vector<BeamEnd> beams;
};

std::vector<Scan> random_scans(int count, std::uint32_t seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> place(-8.0, 8.0);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  std::uniform_real_distribution<double> range(0.1, 5.0);
  std::vector<Scan> scans;
  for (int i = 0; i < count; ++i) {
    Scan scan{Pose2(place(generator), place(generator), angle(generator)), {}};
    for (int beam = 0; beam < 4; ++beam) {
      const double r = range(generator);
      const double bearing = beam * kPi / 2.0;
      scan.beams.push_back({{r * std::cos(bearing), r * std::sin(bearing)}, beam != 0});
    }
    scans.push_back(scan);
  }
  return scans;
}

TEST(ScanDrawing, DrawsASmallRoom) {
  ScanDrawing drawing(metre_cells(), 10.0, 10.0);
  const std::vector<BeamEnd> beams = {{{4, 0}, true}, {{0, 2}, true}, {{-4, 0}, true}, {{0, -2}, true}};
  drawing.draw(ScanId{0}, {4.5, 2.5, 0.0}, {beams});
  drawing.store().publish();
  EXPECT_THAT(picture(drawing.store(), 9, 5), testing::ElementsAre("    #    ",  //
                                                                   "    .    ",  //
                                                                   "#.......#",  //
                                                                   "    .    ",  //
                                                                   "    #    "));
}

TEST(ScanDrawing, ABeamWithoutReturnOnlyClears) {
  ScanDrawing drawing(metre_cells(), 10.0, 10.0);
  drawing.draw(ScanId{0}, {0.5, 0.5, 0.0}, {std::vector<BeamEnd>{{{4, 0}, false}}});
  drawing.store().publish();
  EXPECT_THAT(picture(drawing.store(), 6, 1), testing::ElementsAre("....  "));
}

TEST(ScanDrawing, ClearsUpToItsRangeAndMarksHitsBeyond) {
  ScanDrawing drawing(metre_cells(), 3.0, 3.0);
  drawing.draw(ScanId{0}, {0.5, 0.5, 0.0}, {std::vector<BeamEnd>{{{6, 0}, true}}});
  drawing.store().publish();
  EXPECT_THAT(picture(drawing.store(), 8, 1), testing::ElementsAre("...   # "));
}

TEST(ScanDrawing, ALongBeamEndsInItsPlaceHoweverLittleIsCleared) {
  ScanDrawing drawing(metre_cells(), 0.1, 6.0);
  drawing.draw(ScanId{0}, {0.5, 0.5, 0.5}, {std::vector<BeamEnd>{{{6, 0}, true}}});
  drawing.store().publish();
  EXPECT_EQ(picture(drawing.store(), 7, 4).front(), "     # ");
}

TEST(ScanDrawing, MovingAScanLeavesNoTraceOfWhereItWas) {
  ScanDrawing drawing(metre_cells(), 10.0, 10.0);
  const std::vector<BeamEnd> beams = {{{3, 0}, true}};
  drawing.draw(ScanId{0}, {0.5, 0.5, 0.0}, {beams});
  drawing.store().publish();
  EXPECT_THAT(picture(drawing.store(), 5, 4), testing::ElementsAre("     ", "     ", "     ", "...# "));
  drawing.draw(ScanId{0}, {0.5, 0.5, kPi / 2.0}, {beams});
  drawing.store().publish();
  EXPECT_THAT(picture(drawing.store(), 5, 4), testing::ElementsAre("#    ", ".    ", ".    ", ".    "));
}

TEST(ScanDrawing, DoesNotDependOnTheWayThePosesCameAbout) {
  const std::vector<Scan> last = random_scans(200, 1);
  ScanDrawing at_once(MapConfig{}, 3.0, 3.0);
  for (std::size_t i = 0; i < last.size(); ++i)
    at_once.draw(make_id<ScanId>(i), last[i].T_map_body, {last[i].beams});

  ScanDrawing wandering(MapConfig{}, 3.0, 3.0);
  std::mt19937 generator(2);
  for (std::uint32_t round = 0; round < 5; ++round) {
    const std::vector<Scan> elsewhere = random_scans(200, 100 + round);
    std::vector<std::size_t> order(last.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), generator);
    for (const std::size_t i : order)
      wandering.draw(make_id<ScanId>(i), elsewhere[i].T_map_body, {last[i].beams});
  }
  for (std::size_t i = last.size(); i-- > 0;)
    wandering.draw(make_id<ScanId>(i), last[i].T_map_body, {last[i].beams});
  expect_same_map(at_once, wandering);
}

TEST(ScanDrawing, ManySmallCorrectionsEndWhereOneLargeOneDoes) {
  const std::vector<Scan> scans = random_scans(50, 3);
  const Pose2 T_moved_map(0.31, -0.17, 0.02);
  ScanDrawing creeping(MapConfig{}, 3.0, 3.0);
  ScanDrawing jumping(MapConfig{}, 3.0, 3.0);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    for (int step = 0; step <= 400; ++step) {
      const double share = step / 400.0;
      const Pose2 T_part_map(T_moved_map.x_m() * share, T_moved_map.y_m() * share,
                             T_moved_map.yaw_rad() * share);
      creeping.draw(make_id<ScanId>(i), T_part_map * scans[i].T_map_body, {scans[i].beams});
    }
    jumping.draw(make_id<ScanId>(i), T_moved_map * scans[i].T_map_body, {scans[i].beams});
  }
  expect_same_map(creeping, jumping);
}

TEST(ScanDrawing, RedrawsNothingForAMoveBelowTheLattice) {
  ScanDrawing drawing(MapConfig{}, 3.0, 3.0);
  drawing.draw(ScanId{0}, {1.0, 1.0, 0.0}, {std::vector<BeamEnd>{{{1, 0}, true}}});
  EXPECT_FALSE(drawing.needs_drawing(ScanId{0}, {1.0005, 1.0, 0.0}));
  EXPECT_TRUE(drawing.needs_drawing(ScanId{0}, {1.01, 1.0, 0.0}));
  EXPECT_TRUE(drawing.needs_drawing(ScanId{0}, {1.0, 1.0, 0.01}));
  EXPECT_TRUE(drawing.needs_drawing(ScanId{1}, {1.0, 1.0, 0.0}));
}

TEST(ScanDrawing, DrawsNothingAtAPoseThatIsNone) {
  ScanDrawing drawing(MapConfig{}, 3.0, 3.0);
  const std::vector<BeamEnd> beams = {{{1, 0}, true}};
  drawing.draw(ScanId{0}, {1.0, 1.0, 0.0}, {beams});
  drawing.draw(ScanId{0}, {1e9, 1.0, 0.0}, {beams});
  drawing.draw(ScanId{1}, {std::numeric_limits<double>::quiet_NaN(), 1.0, 0.0}, {beams});
  EXPECT_TRUE(all_tiles(drawing).empty());
}

}  // namespace
}  // namespace swiftlet

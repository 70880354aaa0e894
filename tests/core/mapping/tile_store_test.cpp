// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/tile_store.hpp"

#include <gmock/gmock.h>

namespace swiftlet {
namespace {

using Change = TileStore::Change;
using testing::ElementsAre;
using testing::IsEmpty;

std::int8_t percent_at(const TileStore& store, CellIndex cell) {
  const TileIndex index{cell.x >= 0 ? cell.x / kTileCells : (cell.x + 1) / kTileCells - 1,
                        cell.y >= 0 ? cell.y / kTileCells : (cell.y + 1) / kTileCells - 1};
  const auto column = static_cast<std::size_t>(cell.x - index.x * kTileCells);
  const auto row = static_cast<std::size_t>(cell.y - index.y * kTileCells);
  return store.tile(index).occupancy_percent[row * kTileCells + column];
}

TEST(OccupancyPercent, IsUnknownWithoutEvidence) { EXPECT_EQ(occupancy_percent({}, {}), -1); }

TEST(OccupancyPercent, AddsUpLogOdds) {
  // 1 / (1 + exp(-0.85)) and 1 / (1 + exp(0.4)), by hand.
  EXPECT_EQ(occupancy_percent({1, 0}, {}), 70);
  EXPECT_EQ(occupancy_percent({0, 1}, {}), 40);
  EXPECT_EQ(occupancy_percent({1, 1}, {}), 61);
}

TEST(OccupancyPercent, IsLimited) {
  EXPECT_EQ(occupancy_percent({4'000'000'000U, 0}, {}), 98);
  EXPECT_EQ(occupancy_percent({0, 4'000'000'000U}, {}), 2);
}

TEST(TileStore, PutsCellsOfEitherSignInTheirTiles) {
  TileStore store{MapConfig{}};
  const CellIndex cells[] = {{0, 0}, {63, 63}, {64, 0}, {-1, -1}, {-64, 5}, {-65, 5}};
  for (const CellIndex cell : cells) store.add_hit(cell, Change::kCount);
  EXPECT_THAT(store.publish(), ElementsAre(TileIndex{-2, 0}, TileIndex{-1, -1}, TileIndex{-1, 0},
                                           TileIndex{0, 0}, TileIndex{1, 0}));
  for (const CellIndex cell : cells) EXPECT_EQ(percent_at(store, cell), 70);
  EXPECT_EQ(percent_at(store, {1, 0}), -1);
}

TEST(TileStore, CountsUpTheVersionOnlyWhenThePublishedContentChanges) {
  TileStore store{MapConfig{}};
  store.add_hit({1, 1}, Change::kCount);
  EXPECT_THAT(store.publish(), ElementsAre(TileIndex{0, 0}));
  EXPECT_EQ(store.tile({0, 0}).version, 1U);
  EXPECT_THAT(store.publish(), IsEmpty());
  store.add_miss({2, 2}, Change::kCount);
  store.add_miss({2, 2}, Change::kTakeBack);
  EXPECT_THAT(store.publish(), IsEmpty());
  store.add_miss({2, 2}, Change::kCount);
  EXPECT_THAT(store.publish(), ElementsAre(TileIndex{0, 0}));
  EXPECT_EQ(store.tile({0, 0}).version, 2U);
}

TEST(TileStore, PublishesThatATileBecameEmptyAndLeavesItOutOfTheList) {
  TileStore store{MapConfig{}};
  store.add_hit({1, 1}, Change::kCount);
  store.publish();
  store.add_hit({1, 1}, Change::kTakeBack);
  EXPECT_THAT(store.publish(), ElementsAre(TileIndex{0, 0}));
  EXPECT_THAT(store.tiles(), IsEmpty());
  EXPECT_EQ(percent_at(store, {1, 1}), -1);
}

TEST(TileStore, ATileThatFillsAgainCountsItsVersionsOn) {
  TileStore store{MapConfig{}};
  store.add_hit({1, 1}, Change::kCount);
  store.publish();
  store.add_hit({1, 1}, Change::kTakeBack);
  store.publish();
  EXPECT_EQ(store.tile({0, 0}).version, 2U);
  store.add_miss({5, 5}, Change::kCount);
  EXPECT_THAT(store.publish(), ElementsAre(TileIndex{0, 0}));
  EXPECT_EQ(store.tile({0, 0}).version, 3U);
  EXPECT_EQ(percent_at(store, {1, 1}), -1);
  EXPECT_EQ(percent_at(store, {5, 5}), 40);
}

TEST(TileStore, CountsBeyondSixteenBitsAndTakesThemBack) {
  const MapConfig config;
  TileStore store(config);
  constexpr std::uint32_t kMany = 70'000;  // an hour's hovering
  for (std::uint32_t i = 0; i < kMany; ++i) store.add_hit({3, 3}, Change::kCount);
  for (std::uint32_t i = 0; i < 2 * kMany; ++i) store.add_miss({3, 3}, Change::kCount);
  store.publish();
  EXPECT_EQ(percent_at(store, {3, 3}), occupancy_percent({kMany, 2 * kMany}, config));
  for (std::uint32_t i = 0; i < kMany; ++i) store.add_hit({3, 3}, Change::kTakeBack);
  for (std::uint32_t i = 0; i < 2 * kMany; ++i) store.add_miss({3, 3}, Change::kTakeBack);
  store.publish();
  EXPECT_EQ(percent_at(store, {3, 3}), -1);
}

TEST(TileStore, ACountThatPassesTheBoundsOfItsBytesAgainAndAgainLeavesNoTrace) {
  const MapConfig config;
  TileStore store(config);
  for (const std::uint32_t bound : {256U, 65'536U}) {
    for (std::uint32_t i = 0; i < bound - 1; ++i) store.add_miss({9, 9}, Change::kCount);
    for (int round = 0; round < 3; ++round) {
      store.add_miss({9, 9}, Change::kCount);
      store.add_hit({9, 9}, Change::kCount);
      store.publish();
      EXPECT_EQ(percent_at(store, {9, 9}), occupancy_percent({1, bound}, config));
      store.add_miss({9, 9}, Change::kTakeBack);
      store.add_hit({9, 9}, Change::kTakeBack);
    }
    for (std::uint32_t i = 0; i < bound - 1; ++i) store.add_miss({9, 9}, Change::kTakeBack);
    store.add_hit({8, 8}, Change::kCount);
    store.publish();
    EXPECT_EQ(percent_at(store, {9, 9}), -1);
  }
}

TEST(TileStore, AnswersForATileThatNeverWas) {
  const MapTile tile = TileStore{MapConfig{}}.tile({7, -3});
  EXPECT_EQ(tile.index, (TileIndex{7, -3}));
  EXPECT_EQ(tile.version, 0U);
  EXPECT_THAT(tile.occupancy_percent, testing::Each(-1));
}

TEST(TileStore, AgreesWithTheFormulaForManyCounts) {
  const MapConfig config;
  TileStore store(config);
  for (int count = 1; count <= 300; ++count) {
    store.add_miss({0, 0}, Change::kCount);
    if (count % 4 == 0) store.add_hit({0, 0}, Change::kCount);
    store.publish();
    const auto hits = static_cast<std::uint32_t>(count / 4);
    ASSERT_EQ(percent_at(store, {0, 0}),
              occupancy_percent({hits, static_cast<std::uint32_t>(count)}, config));
  }
}

}  // namespace
}  // namespace swiftlet

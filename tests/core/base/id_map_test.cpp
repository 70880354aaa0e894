// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/base/id_map.hpp"

#include <gmock/gmock.h>

#include <map>
#include <random>

namespace swiftlet {
namespace {

using testing::ElementsAre;
using Range = IdRange<ScanId>;
using Map = IdMap<ScanId, int>;

ScanId id(std::uint32_t number) { return make_id<ScanId>(number); }

Range range(std::uint32_t first, std::uint32_t end) { return {id(first), id(end)}; }

IdRanges<ScanId> ranges(const std::vector<Range>& all) {
  IdRanges<ScanId> ranges;
  for (const Range& r : all) ranges.add(r);
  return ranges;
}

/// Of each id ten times its number.
Map tens(std::uint32_t count) {
  Map map;
  for (std::uint32_t i = 0; i < count; ++i) map.push_back(static_cast<int>(10 * i));
  return map;
}

TEST(IdRanges, MergesThoseThatTouchAndTakesNoNoticeOfEmptyOnes) {
  const IdRanges<ScanId> merged = ranges({range(2, 4), range(4, 4), range(4, 7), range(9, 9), range(9, 10)});
  EXPECT_THAT(std::vector<Range>(merged.begin(), merged.end()), ElementsAre(range(2, 7), range(9, 10)));
  EXPECT_TRUE(merged.contains(id(2)));
  EXPECT_TRUE(merged.contains(id(6)));
  EXPECT_FALSE(merged.contains(id(1)));
  EXPECT_FALSE(merged.contains(id(7)));
  EXPECT_TRUE(merged.contains(id(9)));
  EXPECT_FALSE(merged.contains(id(10)));
}

TEST(IdRangesDeathTest, RangesOutOfOrderAreABrokenPromise) {
  IdRanges<ScanId> some = ranges({range(5, 7)});
  EXPECT_DEATH(some.add(range(6, 9)), "broken promise.*in order");
}

TEST(IdMap, GivesIdsInOrder) {
  Map map;
  EXPECT_TRUE(map.empty());
  EXPECT_EQ(map.push_back(7), id(0));
  EXPECT_EQ(map.push_back(8), id(1));
  EXPECT_EQ(map[id(1)], 8);
  EXPECT_EQ(map.end_id(), id(2));
  EXPECT_FALSE(map.contains(id(2)));
}

TEST(IdMap, ErasedIdsAreGoneAndTheRestKeepTheirs) {
  Map map = tens(10);
  map.erase(ranges({range(1, 3), range(5, 6), range(8, 10)}));
  EXPECT_EQ(map.size(), 5U);
  EXPECT_THAT(std::vector<int>(map.values().begin(), map.values().end()), ElementsAre(0, 30, 40, 60, 70));
  EXPECT_EQ(map[id(3)], 30);
  EXPECT_EQ(map[id(7)], 70);
  EXPECT_TRUE(map.contains(id(0)));
  EXPECT_FALSE(map.contains(id(1)));
  EXPECT_FALSE(map.contains(id(9)));
  EXPECT_EQ(map.last_id(), id(7));
  EXPECT_EQ(map.push_back(100), id(10)) << "an id is not given again";
  EXPECT_EQ(map[id(10)], 100);
}

TEST(IdMap, FindsNeighboursAcrossHoles) {
  Map map = tens(10);
  map.erase(ranges({range(0, 2), range(4, 7)}));
  EXPECT_EQ(map.first_id(), id(2));
  EXPECT_EQ(map.next(id(3)), id(7));
  EXPECT_EQ(map.previous(id(7)), id(3));
  EXPECT_EQ(map.at_or_after(id(5)), id(7));
  EXPECT_EQ(map.at_or_after(id(7)), id(7));
  EXPECT_EQ(map.count(range(0, 10)), 5U);
  EXPECT_EQ(map.count(range(3, 5)), 1U);
  const std::span<const int> some = std::as_const(map).values(range(3, 8));
  EXPECT_THAT(std::vector<int>(some.begin(), some.end()), ElementsAre(30, 70));
}

TEST(IdMap, EntriesAreIdsWithTheirValues) {
  Map map = tens(8);
  map.erase(ranges({range(0, 1), range(3, 5), range(7, 8)}));
  std::map<ScanId, int> seen;
  for (const auto& [at, value] : map) seen.emplace(at, value);
  EXPECT_EQ(seen, (std::map<ScanId, int>{{id(1), 10}, {id(2), 20}, {id(5), 50}, {id(6), 60}}));
}

TEST(IdMap, IdsMayBeLeftOut) {
  Map map = tens(3);
  map.skip_to(id(5));
  map.skip_to(id(4));
  EXPECT_EQ(map.push_back(50), id(5));
  EXPECT_FALSE(map.contains(id(4)));
  EXPECT_EQ(map[id(5)], 50);
  EXPECT_EQ(map.previous(id(5)), id(2));
  map.erase(range(5, 6));
  map.skip_to(id(7));
  EXPECT_EQ(map.push_back(70), id(7));
  EXPECT_EQ(map[id(7)], 70);
  EXPECT_EQ(map.id_at(3), id(7));
}

TEST(IdMap, OtherValuesOfTheSameIds) {
  Map map = tens(4);
  map.erase(range(1, 3));
  const IdMap<ScanId, char> letters = map.with(std::vector<char>{'a', 'b'});
  EXPECT_EQ(letters[id(3)], 'b');
  EXPECT_FALSE(letters.contains(id(2)));
  EXPECT_EQ(letters.end_id(), id(4));
}

TEST(IdMap, EqualsAnOrdinaryMapHoweverItWasErased) {
  std::mt19937 random(7);
  for (int run = 0; run < 50; ++run) {
    Map map;
    std::map<ScanId, int> expected;
    for (int round = 0; round < 6; ++round) {
      for (int i = 0; i < 20; ++i) {
        const int value = static_cast<int>(random() % 1000);
        expected.emplace(map.push_back(value), value);
      }
      IdRanges<ScanId> gone;
      const auto below = [&random](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
      for (std::uint32_t at = below(9); at < index_of(map.end_id()); at += 1 + below(19)) {
        const std::uint32_t end = std::min(index_of(map.end_id()), at + below(9));
        gone.add(range(at, end));
        at = end;
      }
      map.erase(gone);
      std::erase_if(expected, [&](const auto& entry) { return gone.contains(entry.first); });
    }
    ASSERT_EQ(map.size(), expected.size());
    auto at = expected.begin();
    std::size_t position = 0;
    for (const auto& [entry, value] : map) {
      ASSERT_EQ(entry, at->first);
      ASSERT_EQ(value, at->second);
      ASSERT_EQ(map.position(entry), position);
      ASSERT_EQ(map.id_at(position), entry);
      ++position;
      ++at;
    }
    for (std::uint32_t i = 0; i < index_of(map.end_id()); ++i) {
      ASSERT_EQ(map.contains(id(i)), expected.count(id(i)) == 1);
      const auto behind = expected.lower_bound(id(i));
      ASSERT_EQ(map.at_or_after(id(i)), behind == expected.end() ? map.end_id() : behind->first);
    }
  }
}

TEST(IdMapDeathTest, WhatWasErasedCannotBeAskedFor) {
  Map map = tens(5);
  map.erase(range(1, 3));
  EXPECT_DEATH(static_cast<void>(map[id(2)]), "broken promise.*not erased");
}

TEST(IdMapDeathTest, OnlyIdsThatWereGivenAreErased) {
  Map map = tens(5);
  EXPECT_DEATH(map.erase(range(4, 6)), "broken promise.*were given");
}

}  // namespace
}  // namespace swiftlet

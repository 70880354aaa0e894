// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/round_robin.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Map = IdMap<KeyframeId, char>;

Map map_of(std::size_t count) { return Map(std::vector<char>(count)); }

std::vector<std::uint32_t> take_all(RoundRobin<KeyframeId>& turns, const Map& map) {
  std::vector<std::uint32_t> taken;
  while (!turns.is_done()) taken.push_back(index_of(turns.take(map)));
  return taken;
}

void take(RoundRobin<KeyframeId>& turns, int times, const Map& map) {
  for (int i = 0; i < times; ++i) turns.take(map);
}

void erase(RoundRobin<KeyframeId>& turns, const std::vector<IdRange<KeyframeId>>& ranges, Map& map) {
  IdRanges<KeyframeId> gone;
  for (const IdRange<KeyframeId>& range : ranges) gone.add(range);
  turns.erase(gone, map);
  map.erase(gone);
}

IdRange<KeyframeId> range(std::uint32_t first, std::uint32_t end) {
  return {make_id<KeyframeId>(first), make_id<KeyframeId>(end)};
}

TEST(RoundRobin, NothingIsDueAtFirst) { EXPECT_TRUE(RoundRobin<KeyframeId>().is_done()); }

TEST(RoundRobin, VisitsEachOnceFromWhereItEnded) {
  RoundRobin<KeyframeId> turns;
  turns.begin(map_of(5));
  take(turns, 3, map_of(5));
  turns.begin(map_of(6));
  EXPECT_THAT(take_all(turns, map_of(6)), ElementsAre(3, 4, 5, 0, 1, 2));
}

TEST(RoundRobin, WhatIsAddedMeanwhileTakesNobodysTurn) {
  RoundRobin<KeyframeId> turns;
  turns.begin(map_of(5));
  take(turns, 3, map_of(5));
  turns.begin(map_of(5));
  take(turns, 1, map_of(5));
  EXPECT_THAT(take_all(turns, map_of(7)), ElementsAre(4, 0, 1, 2));
}

TEST(RoundRobin, WhatIsErasedBeforeTheTurnChangesNothing) {
  RoundRobin<KeyframeId> turns;
  Map map = map_of(8);
  turns.begin(map);
  take(turns, 4, map);
  erase(turns, {range(1, 3)}, map);
  EXPECT_THAT(take_all(turns, map), ElementsAre(4, 5, 6, 7));
}

TEST(RoundRobin, WhatIsErasedAndWasDueIsDueNoMore) {
  RoundRobin<KeyframeId> turns;
  Map map = map_of(8);
  turns.begin(map);
  take(turns, 3, map);
  erase(turns, {range(2, 4), range(6, 7)}, map);
  EXPECT_THAT(take_all(turns, map), ElementsAre(4, 5, 7));
}

TEST(RoundRobin, TheSameStayDueAcrossTheEnd) {
  RoundRobin<KeyframeId> turns;
  Map map = map_of(8);
  turns.begin(map);
  take(turns, 6, map);
  turns.begin(map);
  take(turns, 1, map);  // due are 7 and 0 to 5, and 6 again
  erase(turns, {range(1, 3), range(5, 7)}, map);
  EXPECT_THAT(take_all(turns, map), ElementsAre(7, 0, 3, 4));
}

TEST(RoundRobin, WhatWasAddedMeanwhileIsNotDueWhenOthersAreErased) {
  RoundRobin<KeyframeId> turns;
  turns.begin(map_of(5));
  take(turns, 3, map_of(5));
  turns.begin(map_of(5));  // due are 3 and 4, and 0 to 2
  Map map = map_of(8);
  erase(turns, {range(1, 2), range(4, 7)}, map);
  EXPECT_THAT(take_all(turns, map), ElementsAre(3, 0, 2));
}

TEST(RoundRobin, WithNothingDueNothingBecomesDue) {
  RoundRobin<KeyframeId> turns;
  Map map = map_of(3);
  turns.begin(map);
  take(turns, 3, map);
  erase(turns, {range(0, 2)}, map);
  EXPECT_THAT(take_all(turns, map), IsEmpty());
}

}  // namespace
}  // namespace swiftlet

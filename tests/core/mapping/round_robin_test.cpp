// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/round_robin.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::size_t> take_all(RoundRobin& turns, std::size_t count) {
  std::vector<std::size_t> taken;
  while (!turns.is_done()) taken.push_back(turns.take(count));
  return taken;
}

void take(RoundRobin& turns, int times, std::size_t count) {
  for (int i = 0; i < times; ++i) turns.take(count);
}

IndexRemoval removal(std::vector<IndexRange> ranges) {
  IndexRemoval removal;
  for (const IndexRange& range : ranges) removal.add(range);
  return removal;
}

TEST(RoundRobin, NothingIsDueAtFirst) { EXPECT_TRUE(RoundRobin().is_done()); }

TEST(RoundRobin, VisitsEachOnceFromWhereItEnded) {
  RoundRobin turns;
  turns.begin(5);
  take(turns, 3, 5);
  turns.begin(6);
  EXPECT_THAT(take_all(turns, 6), ElementsAre(3, 4, 5, 0, 1, 2));
}

TEST(RoundRobin, WhatIsRemovedBeforeTheTurnMovesItUp) {
  RoundRobin turns;
  turns.begin(8);
  take(turns, 4, 8);
  turns.remove(removal({{1, 3}}), 8);  // 0 3 | 4 5 6 7 are now 0 1 | 2 3 4 5
  EXPECT_THAT(take_all(turns, 6), ElementsAre(2, 3, 4, 5));
}

TEST(RoundRobin, WhatIsRemovedAndWasDueIsDueNoMore) {
  RoundRobin turns;
  turns.begin(8);
  take(turns, 3, 8);
  turns.remove(removal({{2, 4}, {6, 7}}), 8);  // due are 4 5 7, now 2 3 4
  EXPECT_THAT(take_all(turns, 5), ElementsAre(2, 3, 4));
}

TEST(RoundRobin, TheSameStayDueAcrossTheEnd) {
  RoundRobin turns;
  turns.begin(8);
  take(turns, 6, 8);
  turns.begin(8);
  take(turns, 1, 8);                           // due are 7 and 0 to 5
  turns.remove(removal({{1, 3}, {5, 7}}), 8);  // of 0 3 4 7, now 0 1 2 3, all but none
  EXPECT_THAT(take_all(turns, 4), ElementsAre(3, 0, 1, 2));
}

TEST(RoundRobin, WithNothingDueNothingBecomesDue) {
  RoundRobin turns;
  turns.begin(3);
  take(turns, 3, 3);
  turns.remove(removal({{0, 2}}), 3);
  EXPECT_THAT(take_all(turns, 1), IsEmpty());
}

}  // namespace
}  // namespace swiftlet

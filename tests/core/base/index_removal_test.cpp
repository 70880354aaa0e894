// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/base/index_removal.hpp"

#include <gmock/gmock.h>

#include <numeric>

namespace swiftlet {
namespace {

using testing::ElementsAre;

IndexRemoval removal(std::initializer_list<IndexRange> ranges) {
  IndexRemoval out;
  for (const IndexRange& range : ranges) out.add(range);
  return out;
}

TEST(IndexRemoval, TakesRangesOutOfASequence) {
  std::vector<int> sequence{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  removal({{1, 3}, {5, 6}, {8, 10}}).apply(sequence);
  EXPECT_THAT(sequence, ElementsAre(0, 3, 4, 6, 7));
}

TEST(IndexRemoval, TellsWhereTheRestMovesUpTo) {
  const IndexRemoval out = removal({{1, 3}, {5, 6}, {8, 10}});
  EXPECT_EQ(out.size(), 5U);
  std::vector<std::uint32_t> sequence(12);
  std::iota(sequence.begin(), sequence.end(), 0U);
  std::vector<std::uint32_t> kept = sequence;
  out.apply(kept);
  for (const std::uint32_t index : sequence) {
    if (out.removes(index)) continue;
    EXPECT_EQ(kept[out.new_index(index)], index);
  }
  EXPECT_EQ(out.new_index(12), 7U) << "one behind the last";
}

TEST(IndexRemoval, OfWhatGoesTellsWhereTheNextMovesUpTo) {
  const IndexRemoval out = removal({{1, 3}, {5, 6}});
  EXPECT_EQ(out.new_index(1), out.new_index(3));
  EXPECT_EQ(out.new_index(2), out.new_index(3));
  EXPECT_EQ(out.new_index(5), out.new_index(6));
}

TEST(IndexRemoval, MergesRangesThatTouchAndTakesNoNoticeOfEmptyOnes) {
  const IndexRemoval out = removal({{2, 4}, {4, 4}, {4, 7}, {9, 9}});
  ASSERT_EQ(out.ranges().size(), 1U);
  EXPECT_EQ(out.ranges()[0].first, 2U);
  EXPECT_EQ(out.ranges()[0].end, 7U);
  EXPECT_EQ(out.new_index(7), 2U);
}

TEST(IndexRemoval, OfNothingChangesNothing) {
  std::vector<int> sequence{4, 5, 6};
  IndexRemoval{}.apply(sequence);
  EXPECT_THAT(sequence, ElementsAre(4, 5, 6));
  EXPECT_EQ(IndexRemoval{}.new_index(2), 2U);
  EXPECT_FALSE(IndexRemoval{}.removes(0));
}

TEST(IndexRemovalDeathTest, RangesOutOfOrderAreABrokenPromise) {
  IndexRemoval out = removal({{5, 7}});
  EXPECT_DEATH(out.add({6, 9}), "broken promise.*in order");
}

}  // namespace
}  // namespace swiftlet

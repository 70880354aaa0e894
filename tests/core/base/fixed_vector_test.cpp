// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/base/fixed_vector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swiftlet {
namespace {

using ::testing::ElementsAre;

template <std::size_t kCapacity>
FixedVector<int, kCapacity> counted_to(int count) {
  FixedVector<int, kCapacity> list;
  for (int i = 0; i < count; ++i) EXPECT_TRUE(list.try_push_back(i));
  return list;
}

TEST(FixedVector, RefusesWhatDoesNotFitAndStaysAsItWas) {
  FixedVector<int, 3> list = counted_to<3>(3);
  EXPECT_TRUE(list.full());
  EXPECT_FALSE(list.try_push_back(99));
  EXPECT_THAT(list, ElementsAre(0, 1, 2));
}

TEST(FixedVector, EraseKeepsTheOrderOfTheOthers) {
  FixedVector<int, 5> list = counted_to<5>(5);
  list.erase(1);
  EXPECT_THAT(list, ElementsAre(0, 2, 3, 4));
  list.erase(3);
  EXPECT_THAT(list, ElementsAre(0, 2, 3));
}

TEST(FixedVector, EraseFrontRemovesTheFirstOnes) {
  FixedVector<int, 5> list = counted_to<5>(5);
  list.erase_front(0);
  EXPECT_EQ(list.size(), 5U);
  list.erase_front(3);
  EXPECT_THAT(list, ElementsAre(3, 4));
  list.erase_front(2);
  EXPECT_TRUE(list.empty());
}

TEST(FixedVector, TruncateKeepsTheFirstOnes) {
  FixedVector<int, 4> list = counted_to<4>(4);
  list.truncate(2);
  EXPECT_THAT(list, ElementsAre(0, 1));
  EXPECT_EQ(list.front(), 0);
  EXPECT_EQ(list.back(), 1);
}

TEST(FixedVectorDeathTest, StopsOnAnIndexOutside) {
  FixedVector<int, 4> list = counted_to<4>(2);
  EXPECT_DEATH(static_cast<void>(list[2]), "index lies inside");
  EXPECT_DEATH(list.truncate(3), "truncating never grows");
  EXPECT_DEATH(list.erase_front(3), "no more is removed");
}

TEST(FixedVector, OfPlainStructsMayCrossAQueue) {
  static_assert(std::is_trivially_copyable_v<FixedVector<int, 4>>);
}

}  // namespace
}  // namespace swiftlet

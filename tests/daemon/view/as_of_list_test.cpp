// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/as_of_list.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/daemon/view/view_samples.hpp"

namespace swiftlet {
namespace {

TEST(AsOfList, FindsTheNewestThatIsNotLater) {
  AsOfList<int> list;
  EXPECT_EQ(list.at(5), nullptr);
  list.append(10, 1);
  list.append(20, 2);
  EXPECT_EQ(list.at(9), nullptr);
  EXPECT_EQ(value_of(list.at(10)), 1);
  EXPECT_EQ(value_of(list.at(19)), 1);
  EXPECT_EQ(value_of(list.at(1000)), 2);
}

TEST(AsOfList, TheLaterOfTwoAtOneTimeCounts) {
  AsOfList<int> list;
  list.append(10, 1);
  list.append(10, 2);
  EXPECT_EQ(value_of(list.at(10)), 2);
  EXPECT_EQ(list.size(), 2U);
}

TEST(AsOfList, ATimeThatGoesBackCountsAsTheNewest) {
  AsOfList<int> list;
  list.append(10, 1);
  list.append(4, 2);
  EXPECT_EQ(list.at(4), nullptr);
  EXPECT_EQ(value_of(list.at(10)), 2);
}

TEST(AsOfList, WhatFollowsTooSoonTakesThePlaceOfTheNewest) {
  AsOfList<int> list;
  for (int i = 0; i <= 100; ++i) list.append_spaced(i, i, 10);
  EXPECT_EQ(value_of(list.newest()), 100);
  EXPECT_LE(list.size(), 21U);
  EXPECT_NEAR(value_of(list.at(50)), 50, 10);
}

TEST(AsOfList, ThinningKeepsTheOldestAndTheNewest) {
  AsOfList<int> list;
  for (int i = 0; i < 8; ++i) list.append(i, i);
  std::vector<int> forgotten;
  list.thin([&](int value) { forgotten.push_back(value); });
  EXPECT_EQ(value_of(list.at(0)), 0);
  EXPECT_EQ(value_of(list.newest()), 7);
  EXPECT_EQ(list.size() + forgotten.size(), 8U);
  EXPECT_LT(list.size(), 8U);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/view/as_of_list.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace swiftlet {
namespace {

TEST(AsOfList, FindsTheNewestThatIsNotLater) {
  AsOfList<int> list;
  EXPECT_EQ(list.at(5), nullptr);
  list.append(10, 1);
  list.append(20, 2);
  EXPECT_EQ(list.at(9), nullptr);
  EXPECT_EQ(list.at(10)->value, 1);
  EXPECT_EQ(list.at(19)->value, 1);
  EXPECT_EQ(list.at(1000)->value, 2);
}

TEST(AsOfList, TheLaterOfTwoAtOneTimeCounts) {
  AsOfList<int> list;
  list.append(10, 1);
  list.append(10, 2);
  EXPECT_EQ(list.at(10)->value, 2);
  EXPECT_NE(list.at(10)->serial, 1U);
}

TEST(AsOfList, ATimeThatGoesBackCountsAsTheNewest) {
  AsOfList<int> list;
  list.append(10, 1);
  list.append(4, 2);
  EXPECT_EQ(list.at(4), nullptr);
  EXPECT_EQ(list.at(10)->value, 2);
}

TEST(AsOfList, WhatFollowsTooSoonTakesThePlaceOfTheNewest) {
  AsOfList<int> list;
  for (int i = 0; i <= 100; ++i) list.append_spaced(i, i, 10);
  EXPECT_EQ(list.newest()->value, 100);
  EXPECT_LE(list.size(), 21U);
  EXPECT_NEAR(list.at(50)->value, 50, 10);
}

TEST(AsOfList, ThinningKeepsTheOldestAndTheNewest) {
  AsOfList<int> list;
  for (int i = 0; i < 8; ++i) list.append(i, i);
  std::vector<int> forgotten;
  list.thin([&](int value) { forgotten.push_back(value); });
  EXPECT_EQ(list.at(0)->value, 0);
  EXPECT_EQ(list.newest()->value, 7);
  EXPECT_EQ(list.size() + forgotten.size(), 8U);
  EXPECT_LT(list.size(), 8U);
}

}  // namespace
}  // namespace swiftlet

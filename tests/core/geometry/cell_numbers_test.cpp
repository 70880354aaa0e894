// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/geometry/cell_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

TEST(CellNumbers, CountInTheOrderOfFirstAppearance) {
  constexpr double kCellM = 0.08;
  std::mt19937 random(84);
  CellNumbers numbers(kCellM);
  for (const int points : {1, 40, 3000}) {
    numbers.reset(static_cast<std::size_t>(points));
    std::map<std::pair<double, double>, std::size_t> expected;
    for (int i = 0; i < points; ++i) {
      const Point2 p{random_in(random, -2.0, 2.0), random_in(random, -2.0, 2.0)};
      const auto cell = std::pair(std::floor(p.x_m / kCellM), std::floor(p.y_m / kCellM));
      const auto [at, is_first] = expected.try_emplace(cell, expected.size());
      ASSERT_EQ(numbers.number_of(p), at->second);
      ASSERT_EQ(numbers.size(), expected.size());
    }
  }
}

TEST(CellNumbers, TellTheFirstPointOfEachCell) {
  CellNumbers numbers(1.0);
  numbers.reset(3);
  EXPECT_TRUE(numbers.is_first({0.1, 0.1}));
  EXPECT_FALSE(numbers.is_first({0.9, 0.9}));
  EXPECT_TRUE(numbers.is_first({-0.1, 0.1})) << "cells left of zero are their own";
  EXPECT_TRUE(numbers.is_first({0.1, -0.1}));
  EXPECT_FALSE(numbers.is_first({-0.9, 0.9}));
}

TEST(CellNumbers, ForgetAllWhenBegunAnew) {
  CellNumbers numbers(1.0);
  numbers.reset(2);
  EXPECT_EQ(numbers.number_of({0.5, 0.5}), 0U);
  EXPECT_EQ(numbers.number_of({1.5, 0.5}), 1U);
  numbers.reset(2);
  EXPECT_EQ(numbers.size(), 0U);
  EXPECT_EQ(numbers.number_of({1.5, 0.5}), 0U);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/chi_square.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>

namespace swiftlet {
namespace {

TEST(ChiSquareTable, HoldsThePrintedValues) {
  const ChiSquareTable table(0.95);
  EXPECT_EQ(table.quantile(0), 0.0);
  EXPECT_NEAR(table.quantile(1), 3.841, 1e-3);
  EXPECT_NEAR(table.quantile(2), 5.991, 1e-3);
  EXPECT_NEAR(table.quantile(10), 18.307, 1e-3);
  EXPECT_NEAR(ChiSquareTable(0.99).quantile(2), 9.210, 1e-3);
}

TEST(ChiSquareTable, GoesOnSmoothlyBeyondItsEnd) {
  const ChiSquareTable table(0.95);
  for (const std::size_t n : {ChiSquareTable::kMaxDegrees + 1, std::size_t{2000}}) {
    const double exact = boost::math::quantile(boost::math::chi_squared(static_cast<double>(n)), 0.95);
    EXPECT_NEAR(table.quantile(n), exact, 0.05);
  }
}

}  // namespace
}  // namespace swiftlet

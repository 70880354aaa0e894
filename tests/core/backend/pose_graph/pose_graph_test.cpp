// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/pose_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swiftlet {
namespace {

TEST(DcsScale, FollowsItsEquation) {
  EXPECT_DOUBLE_EQ(dcs_scale(0.0, 5.0), 1.0);
  EXPECT_DOUBLE_EQ(dcs_scale(5.0, 5.0), 1.0);
  EXPECT_DOUBLE_EQ(dcs_scale(10.0, 5.0), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(dcs_scale(45.0, 5.0), 0.2);
  EXPECT_DOUBLE_EQ(dcs_scale(3.0, 1.0), 0.5);
}

TEST(DcsScale, FallsSteadilyBeyondPhi) {
  for (int i = 0; i < 20; ++i) {
    const double chi_square = 5.0 * std::pow(2.0, i);
    EXPECT_LT(dcs_scale(2.0 * chi_square, 5.0), dcs_scale(chi_square, 5.0));
    EXPECT_GT(dcs_scale(chi_square, 5.0), 0.0);
  }
}

}  // namespace
}  // namespace swiftlet

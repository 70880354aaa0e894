// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/confidence/recent_innovation.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

TEST(RecentInnovation, IsTheMeanOfAllDegreesOfFreedom) {
  RecentInnovation innovation;
  EXPECT_EQ(innovation.per_degree(), 0.0);
  innovation.add(8.0, 4);
  EXPECT_DOUBLE_EQ(innovation.per_degree(), 2.0);
  innovation.add(0.0, 0);
  EXPECT_DOUBLE_EQ(innovation.per_degree(), 2.0) << "no wall was seen";
  for (int i = 0; i < 100; ++i) innovation.add(i % 2 == 0 ? 12.0 : 0.0, i % 2 == 0 ? 8 : 4);
  EXPECT_NEAR(innovation.per_degree(), 1.0, 0.1) << "12 of 12, not the mean of 1.5 and 0";
}

TEST(RecentInnovation, ForgetsWhatLiesTwentyKeyframesBack) {
  RecentInnovation innovation;
  for (int i = 0; i < 100; ++i) innovation.add(400.0, 4);
  for (int i = 0; i < 50; ++i) innovation.add(4.0, 4);
  EXPECT_LT(innovation.per_degree(), 2.0);
}

}  // namespace
}  // namespace swiftlet

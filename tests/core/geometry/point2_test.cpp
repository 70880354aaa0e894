// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/geometry/point2.hpp"

#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

TEST(Point2, DistanceAndBearingOfAnother) {
  EXPECT_DOUBLE_EQ(distance_m({1.0, 2.0}, {4.0, -2.0}), 5.0);
  EXPECT_DOUBLE_EQ(bearing_rad({1.0, 1.0}, {0.0, 2.0}), 0.75 * kPi);
}

TEST(Point2, ASegmentIsNearestAtItsFootOrAtAnEnd) {
  const Point2 start{0.0, 0.0};
  const Point2 end{4.0, 0.0};
  EXPECT_DOUBLE_EQ(distance_to_segment_m({1.0, -2.0}, start, end), 2.0);
  EXPECT_DOUBLE_EQ(distance_to_segment_m({-3.0, 4.0}, start, end), 5.0);
  EXPECT_DOUBLE_EQ(distance_to_segment_m({7.0, 4.0}, start, end), 5.0);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "firmware_link/simulation/outline.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swiftlet {
namespace {

const Outline kSquare = rectangle({}, 0.0, 0.0, 2.0, 2.0);

TEST(Outline, ContainsWhatLiesInside) {
  EXPECT_TRUE(contains(kSquare, {1.0, 1.9}));
  EXPECT_FALSE(contains(kSquare, {1.0, 2.1}));
  const Outline turned = transformed(Pose2(5.0, 0.0, kPi / 4.0), kSquare);
  EXPECT_TRUE(contains(turned, {5.0, 2.0}));
  EXPECT_FALSE(contains(turned, {6.5, 0.5}));
}

TEST(Outline, IsApartFromWhatAStripSeparates) {
  const Outline other = rectangle({}, 2.5, 0.0, 3.0, 2.0);
  EXPECT_TRUE(are_apart(kSquare, other, 0.4));
  EXPECT_FALSE(are_apart(kSquare, other, 0.6));
  EXPECT_FALSE(are_apart(kSquare, rectangle({}, 1.0, 1.0, 3.0, 3.0), 0.0));
}

TEST(Outline, ClipsAWallThatPassesThrough) {
  const auto share = share_inside({{-2.0, 1.0}, {6.0, 1.0}}, kSquare);
  ASSERT_TRUE(share);
  EXPECT_NEAR(share->from, 0.25, 1e-3);
  EXPECT_NEAR(share->to, 0.5, 1e-3);
}

TEST(Outline, DoesNotClipAWallOutsideOrOnItsSide) {
  EXPECT_FALSE(share_inside({{-2.0, 3.0}, {6.0, 3.0}}, kSquare));
  EXPECT_FALSE(share_inside({{0.0, 2.0}, {2.0, 2.0}}, kSquare));
  EXPECT_FALSE(share_inside({{3.0, 1.0}, {6.0, 1.0}}, kSquare));
}

TEST(WallDistance, IsThatOfTheNearestPoint) {
  const WallSegment wall{{0.0, 0.0}, {4.0, 0.0}};
  EXPECT_NEAR(distance_m(wall, Point2{1.0, 2.0}), 2.0, 1e-12);
  EXPECT_NEAR(distance_m(wall, Point2{7.0, 4.0}), 5.0, 1e-12);
}

TEST(RegularPolygon, HasItsCornersOnACircle) {
  const Outline hexagon = regular_polygon({1.0, 2.0}, 3.0, 6);
  ASSERT_EQ(hexagon.size(), 6U);
  for (const Point2& corner : hexagon) EXPECT_NEAR(distance_m(corner, {1.0, 2.0}), 3.0, 1e-12);
  EXPECT_TRUE(contains(hexagon, {1.0, 2.0})) << "counter-clockwise";
}

}  // namespace
}  // namespace swiftlet

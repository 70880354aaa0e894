// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/nearest_wall.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace swiftlet {
namespace {

std::vector<Point2> wall_along_x(double y_m) {
  std::vector<Point2> returns;
  for (int i = -10; i <= 10; ++i) returns.push_back({0.05 * i, y_m});
  return returns;
}

TEST(NearestWall, HasTheNormalOfTheReturnsAroundTheNearestOne) {
  std::vector<Point2> returns = wall_along_x(1.0);
  for (int i = -10; i <= 10; ++i) returns.push_back({-2.0, 0.05 * i});  // farther off
  const auto normal = nearest_wall_normal(returns, {0.0, 0.0});
  ASSERT_TRUE(normal.has_value());
  EXPECT_NEAR(std::abs(normal->y_m), 1.0, 1e-9);
  EXPECT_NEAR(normal->x_m, 0.0, 1e-9);
}

TEST(NearestWall, IsNoneWhereReturnsAreFewOrDrawNoLine) {
  EXPECT_FALSE(nearest_wall_normal({}, {}).has_value());
  EXPECT_FALSE(nearest_wall_normal(std::vector<Point2>{{1, 0}, {1, 0.1}}, {}).has_value());
  std::vector<Point2> blob;
  for (int i = 0; i < 16; ++i) blob.push_back({1.0 + 0.1 * (i % 4), 0.1 * (i / 4)});
  EXPECT_FALSE(nearest_wall_normal(blob, {}).has_value());
}

}  // namespace
}  // namespace swiftlet

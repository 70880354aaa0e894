// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/wall_patches.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace swiftlet {
namespace {

/// Along y = `y_m` from x = 0.02 to 0.48, looked at along `direction`.
std::vector<DrawnReturn> wall_at(double y_m, const Point2& direction, int count = 24) {
  std::vector<DrawnReturn> wall;
  for (int i = 0; i < count; ++i) wall.push_back({{0.02 + 0.46 * i / (count - 1), y_m}, direction});
  return wall;
}

TEST(WallPatches, AWallIsOnePatchThatFacesWhoSeesIt) {
  const WallPatches found = find_wall_patches(wall_at(0.25, {0.0, 1.0}));
  ASSERT_EQ(found.patches.size(), 1U);
  EXPECT_EQ(std::set<std::uint32_t>(found.patch_of.begin(), found.patch_of.end()),
            std::set<std::uint32_t>{0});
  EXPECT_NEAR(found.patches[0].normal_map.y_m, -1.0, 1e-9);
  EXPECT_NEAR(found.patches[0].center_map.y_m, 0.25, 1e-9);
}

TEST(WallPatches, TheTwoFacesOfAThinWallAreTwoPatches) {
  std::vector<DrawnReturn> both = wall_at(0.22, {0.0, 1.0});
  for (const DrawnReturn& other : wall_at(0.28, {0.0, -1.0})) both.push_back(other);
  const WallPatches found = find_wall_patches(both);
  ASSERT_EQ(found.patches.size(), 2U);
  EXPECT_NE(found.patch_of.front(), found.patch_of.back());
}

TEST(WallPatches, ClutterIsNoWall) {
  std::vector<DrawnReturn> clutter;
  for (int i = 0; i < 40; ++i)
    clutter.push_back({{0.25 + 0.2 * std::cos(2.4 * i), 0.25 + 0.2 * std::sin(2.4 * i)}, {0.0, 1.0}});
  EXPECT_TRUE(find_wall_patches(clutter).patches.empty());
}

TEST(WallPatches, AFewReturnsMakeNone) {
  const WallPatches found = find_wall_patches(wall_at(0.25, {0.0, 1.0}, 7));
  EXPECT_TRUE(found.patches.empty());
  EXPECT_EQ(found.patch_of, std::vector<std::uint32_t>(7, WallPatches::kNone));
  EXPECT_TRUE(find_wall_patches({}).patch_of.empty());
}

}  // namespace
}  // namespace swiftlet

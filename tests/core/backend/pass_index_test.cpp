// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pass_index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

PassWalls walls(std::vector<Point2> points) { return {0, std::move(points)}; }

std::vector<std::uint32_t> near(const PassIndex& index, const Point2& place, std::uint32_t excluded_first = 0,
                                std::uint32_t excluded_end = 0) {
  return index.near(std::vector<Point2>{place}, excluded_first, excluded_end);
}

TEST(PassIndex, FindsThePassesWithWallsNearAPlace) {
  std::mt19937 random(31);
  PassIndex index;
  std::vector<std::vector<Point2>> drawn;
  for (std::uint32_t pass = 0; pass < 40; ++pass) {
    const Pose2 T_map_reference = random_pose(random, 12.0);
    std::vector<Point2> points(20);
    for (Point2& p : points) p = {random_in(random, -2.0, 2.0), random_in(random, -2.0, 2.0)};
    index.set(pass, walls(points), T_map_reference);
    for (Point2& p : points) p = T_map_reference * p;
    drawn.push_back(points);
  }
  for (int trial = 0; trial < 200; ++trial) {
    const Point2 place{random_in(random, -12.0, 12.0), random_in(random, -12.0, 12.0)};
    const std::vector<std::uint32_t> found = near(index, place);
    if (found.size() >= PassIndex::kMostPassesPerTile) continue;  // some may have been left out
    for (std::uint32_t pass = 0; pass < drawn.size(); ++pass) {
      double nearest_m = 1e9;
      for (const Point2& p : drawn[pass])
        nearest_m = std::min(nearest_m, std::hypot(p.x_m - place.x_m, p.y_m - place.y_m));
      const bool is_found = std::binary_search(found.begin(), found.end(), pass);
      EXPECT_TRUE(is_found || nearest_m > 0.5) << nearest_m;
      EXPECT_TRUE(!is_found || nearest_m < 4.0) << nearest_m;
    }
  }
}

TEST(PassIndex, LeavesOutTheExcluded) {
  PassIndex index;
  for (std::uint32_t pass = 0; pass < 6; ++pass) index.set(pass, walls({{1.0, 1.0}}), {});
  EXPECT_THAT(near(index, {1.0, 1.0}), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(near(index, {1.0, 1.0}, 1, 4), ElementsAre(0, 4, 5));
  EXPECT_THAT(near(index, {1.0, 1.0}, 0, 6), IsEmpty());
}

TEST(PassIndex, APassIsFoundWhereItMoved) {
  PassIndex index;
  index.set(0, walls({{1.0, 1.0}}), {});
  index.move(0, Pose2(0.1, 0.1, 0.0));
  EXPECT_THAT(near(index, {1.1, 1.1}), ElementsAre(0)) << "a little";
  index.move(0, Pose2(20.0, 0.0, 0.0));
  EXPECT_THAT(near(index, {21.0, 1.0}), ElementsAre(0));
  EXPECT_THAT(near(index, {1.0, 1.0}), IsEmpty());
  index.move(0, Pose2(20.0, 0.0, kPi));
  EXPECT_THAT(near(index, {19.0, -1.0}), ElementsAre(0)) << "and turned";
}

TEST(PassIndex, APassFiledAnewIsForgottenWhereItWas) {
  PassIndex index;
  index.set(0, walls({{1.0, 1.0}, {9.0, 1.0}}), {});
  index.set(0, walls({{9.0, 1.0}}), {});
  EXPECT_THAT(near(index, {1.0, 1.0}), IsEmpty());
  EXPECT_THAT(near(index, {9.0, 1.0}), ElementsAre(0));
  EXPECT_EQ(index.size(), 1U);
}

TEST(PassIndex, OfManyPassesOverOnePlaceTakesAFewFromFirstToLast) {
  PassIndex index;
  for (std::uint32_t pass = 0; pass < 1000; ++pass) index.set(pass, walls({{1.0, 1.0}}), {});
  const std::vector<std::uint32_t> found = near(index, {1.0, 1.0});
  ASSERT_EQ(found.size(), PassIndex::kMostPassesPerTile);
  EXPECT_EQ(found.front(), 0U);
  EXPECT_EQ(found.back(), 999U);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_NEAR(found[i] - found[i - 1], 1000.0 / 7.0, 2.0);
  EXPECT_EQ(near(index, {1.0, 1.0}, 500, 1000).back(), 499U);
}

TEST(PassIndex, WhatItBringsIsBoundedHoweverManyPassesThereAre) {
  std::mt19937 random(32);
  PassIndex index;
  std::vector<Point2> everywhere;
  for (std::uint32_t pass = 0; pass < 500; ++pass) {
    std::vector<Point2> points(1000);
    for (Point2& p : points) p = {random_in(random, -9.0, 9.0), random_in(random, -9.0, 9.0)};
    everywhere.push_back(points[0]);
    index.set(pass, walls(std::move(points)), {});
    EXPECT_EQ(index[pass].points_reference.size(), PassIndex::kMostPointsPerPass);
  }
  const std::vector<std::uint32_t> found = index.near(everywhere, 0, 0);
  EXPECT_EQ(found.size(), PassIndex::kMostPassesNearby);
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
}

TEST(PassIndexDeathTest, AGapBetweenPassesIsABrokenPromise) {
  PassIndex index;
  EXPECT_DEATH(index.set(1, walls({}), {}), "broken promise.*without gaps");
}

TEST(PassIndex, WhatIsRemovedIsFoundNoMoreAndTheRestByItsNewNumber) {
  PassIndex index;
  for (std::uint32_t pass = 0; pass < 6; ++pass) {
    const double x_m = pass < 3 ? 1.0 : 9.0;
    index.set(pass, {10 * pass, {{x_m, 1.0}}}, {});
  }
  IndexRemoval passes;
  passes.add({1, 2});
  passes.add({4, 5});
  IndexRemoval scans;
  scans.add({10, 20});
  scans.add({40, 50});
  index.remove(passes, scans);
  ASSERT_EQ(index.size(), 4U);
  EXPECT_THAT(near(index, {1.0, 1.0}), ElementsAre(0, 1));
  EXPECT_THAT(near(index, {9.0, 1.0}), ElementsAre(2, 3));
  EXPECT_EQ(index[1].reference, 10U) << "was 20";
  EXPECT_EQ(index[3].reference, 30U) << "was 50";
}

}  // namespace
}  // namespace swiftlet

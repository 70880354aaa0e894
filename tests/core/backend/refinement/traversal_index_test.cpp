// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/traversal_index.hpp"

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

TraversalWalls walls(std::vector<Point2> points, StoreyId storey = {}) {
  return {{}, storey, std::move(points)};
}

TraversalId id(std::uint32_t traversal) { return make_id<TraversalId>(traversal); }

std::vector<std::uint32_t> near(const TraversalIndex& index, const std::vector<Point2>& places,
                                const IdRange<TraversalId>& excluded = {}) {
  std::vector<std::uint32_t> found;
  for (const TraversalId traversal : index.near(places, StoreyId{}, excluded))
    found.push_back(index_of(traversal));
  return found;
}
std::vector<std::uint32_t> near(const TraversalIndex& index, const Point2& place,
                                const IdRange<TraversalId>& excluded = {}) {
  return near(index, std::vector<Point2>{place}, excluded);
}

TEST(TraversalIndex, FindsThePassesWithWallsNearAPlace) {
  std::mt19937 random(31);
  TraversalIndex index;
  std::vector<std::vector<Point2>> drawn;
  for (std::uint32_t traversal = 0; traversal < 40; ++traversal) {
    const Pose2 T_map_reference = random_pose(random, 12.0);
    std::vector<Point2> points(20);
    for (Point2& p : points) p = {random_in(random, -2.0, 2.0), random_in(random, -2.0, 2.0)};
    index.set(id(traversal), walls(points), T_map_reference);
    for (Point2& p : points) p = T_map_reference * p;
    drawn.push_back(points);
  }
  for (int trial = 0; trial < 200; ++trial) {
    const Point2 place{random_in(random, -12.0, 12.0), random_in(random, -12.0, 12.0)};
    const std::vector<std::uint32_t> found = near(index, place);
    if (found.size() >= TraversalIndexTuning().max_traversals_per_tile)
      continue;  // some may have been left out
    for (std::uint32_t traversal = 0; traversal < drawn.size(); ++traversal) {
      double nearest_m = 1e9;
      for (const Point2& p : drawn[traversal]) nearest_m = std::min(nearest_m, distance_m(p, place));
      const bool is_found = std::binary_search(found.begin(), found.end(), traversal);
      EXPECT_TRUE(is_found || nearest_m > 0.5) << nearest_m;
      EXPECT_TRUE(!is_found || nearest_m < 4.0) << nearest_m;
    }
  }
}

TEST(TraversalIndex, LeavesOutTheExcluded) {
  TraversalIndex index;
  for (std::uint32_t traversal = 0; traversal < 6; ++traversal)
    index.set(id(traversal), walls({{1.0, 1.0}}), {});
  EXPECT_THAT(near(index, {1.0, 1.0}), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(near(index, {1.0, 1.0}, {id(1), id(4)}), ElementsAre(0, 4, 5));
  EXPECT_THAT(near(index, {1.0, 1.0}, {id(0), id(6)}), IsEmpty());
}

TEST(TraversalIndex, WallsOfAnotherStoreyAreNotNear) {
  TraversalIndex index;
  index.set(id(0), walls({{1.0, 1.0}}), {});
  index.set(id(1), walls({{1.0, 1.0}}, StoreyId{1}), {});
  EXPECT_THAT(near(index, {1.0, 1.0}), ElementsAre(0));
  EXPECT_THAT(index.near(std::vector<Point2>{{1.0, 1.0}}, StoreyId{1}, {}), ElementsAre(id(1)));
}

TEST(TraversalIndex, APassIsFoundWhereItMoved) {
  TraversalIndex index;
  index.set(id(0), walls({{1.0, 1.0}}), {});
  index.move(id(0), Pose2(0.1, 0.1, 0.0));
  EXPECT_THAT(near(index, {1.1, 1.1}), ElementsAre(0)) << "a little";
  index.move(id(0), Pose2(20.0, 0.0, 0.0));
  EXPECT_THAT(near(index, {21.0, 1.0}), ElementsAre(0));
  EXPECT_THAT(near(index, {1.0, 1.0}), IsEmpty());
  index.move(id(0), Pose2(20.0, 0.0, kPi));
  EXPECT_THAT(near(index, {19.0, -1.0}), ElementsAre(0)) << "and turned";
}

TEST(TraversalIndex, APassFiledAnewIsForgottenWhereItWas) {
  TraversalIndex index;
  index.set(id(0), walls({{1.0, 1.0}, {9.0, 1.0}}), {});
  index.set(id(0), walls({{9.0, 1.0}}), {});
  EXPECT_THAT(near(index, {1.0, 1.0}), IsEmpty());
  EXPECT_THAT(near(index, {9.0, 1.0}), ElementsAre(0));
  EXPECT_EQ(index.size(), 1U);
}

TEST(TraversalIndex, OfManyPassesOverOnePlaceTakesAFewFromFirstToLast) {
  TraversalIndex index;
  for (std::uint32_t traversal = 0; traversal < 1000; ++traversal)
    index.set(id(traversal), walls({{1.0, 1.0}}), {});
  const std::vector<std::uint32_t> found = near(index, {1.0, 1.0});
  ASSERT_EQ(found.size(), TraversalIndexTuning().max_traversals_per_tile);
  EXPECT_EQ(found.front(), 0U);
  EXPECT_EQ(found.back(), 999U);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_NEAR(found[i] - found[i - 1], 1000.0 / 7.0, 2.0);
  EXPECT_EQ(near(index, {1.0, 1.0}, {id(500), id(1000)}).back(), 499U);
}

TEST(TraversalIndex, WhatItBringsIsBoundedHoweverManyPassesThereAre) {
  std::mt19937 random(32);
  TraversalIndex index;
  std::vector<Point2> everywhere;
  for (std::uint32_t traversal = 0; traversal < 500; ++traversal) {
    std::vector<Point2> points(1000);
    for (Point2& p : points) p = {random_in(random, -9.0, 9.0), random_in(random, -9.0, 9.0)};
    everywhere.push_back(points[0]);
    index.set(id(traversal), walls(std::move(points)), {});
    EXPECT_EQ(index[id(traversal)].points_reference.size(), TraversalIndexTuning().max_points_per_traversal);
  }
  const std::vector<std::uint32_t> found = near(index, everywhere);
  ASSERT_EQ(found.size(), TraversalIndexTuning().max_traversals_nearby);
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
  EXPECT_LT(found.front(), 20U);
  EXPECT_GT(found.back(), 480U) << "from the first to the last";
}

TEST(TraversalIndexDeathTest, AGapBetweenPassesIsABrokenPromise) {
  TraversalIndex index;
  EXPECT_DEATH(index.set(id(1), walls({}), {}), "broken promise.*in order");
}

TEST(TraversalIndex, WhatIsErasedIsFoundNoMore) {
  TraversalIndex index;
  for (std::uint32_t traversal = 0; traversal < 6; ++traversal) {
    const double x_m = traversal < 3 ? 1.0 : 9.0;
    index.set(id(traversal), {make_id<ScanId>(10 * traversal), {}, {{x_m, 1.0}}}, {});
  }
  IdRanges<TraversalId> gone;
  gone.add(id(1));
  gone.add(id(4));
  index.erase(gone);
  ASSERT_EQ(index.size(), 4U);
  EXPECT_THAT(near(index, {1.0, 1.0}), ElementsAre(0, 2));
  EXPECT_THAT(near(index, {9.0, 1.0}), ElementsAre(3, 5));
  EXPECT_EQ(index[id(5)].reference, ScanId{50});
  EXPECT_THAT(index.filed({id(1), id(5)}), ElementsAre(id(2), id(3)));
  EXPECT_EQ(index.end_id(), id(6));
}

}  // namespace
}  // namespace swiftlet

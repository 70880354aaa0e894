// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/local_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

constexpr double kMomentsRadiusM = 0.3;

std::vector<TraversalPoint> random_points(std::mt19937& random, std::size_t count) {
  std::vector<TraversalPoint> points(count);
  for (TraversalPoint& p : points)
    p = {{random_in(random, -0.5, 0.5), random_in(random, -0.5, 0.5)},
         static_cast<std::uint32_t>(random_int(random, 0, 3))};
  return points;
}

/// Up to three stretches that do not overlap, some of them empty or shorter than a vector.
std::vector<PointRange> random_ranges(std::mt19937& random, std::size_t point_count) {
  std::vector<PointRange> ranges;
  int next = 0;
  for (int i = random_int(random, 0, 3); i > 0; --i) {
    const int begin = random_int(random, next, static_cast<int>(point_count));
    next = random_int(random, begin, static_cast<int>(point_count));
    ranges.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(next)});
  }
  return ranges;
}

TraversalPoint random_place(std::mt19937& random) { return random_points(random, 1).front(); }

Moments2 one_by_one(const std::vector<TraversalPoint>& points, const std::vector<PointRange>& ranges,
                    const TraversalPoint& place) {
  Moments2 m;
  for (const PointRange& range : ranges) {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const double dx = points[i].p_map.x_m - place.p_map.x_m;
      const double dy = points[i].p_map.y_m - place.p_map.y_m;
      const double weight = 1.0 - (dx * dx + dy * dy) / (kMomentsRadiusM * kMomentsRadiusM);
      if (weight <= 0.0 || points[i].traversal == place.traversal) continue;
      m.add({dx, dy}, weight);
    }
  }
  return m;
}

TEST(LocalMoments, AreThoseOfThePointsOneByOne) {
  std::mt19937 random(91);
  std::size_t counted = 0;
  for (std::size_t count = 0; count < 200; ++count) {
    const std::vector<TraversalPoint> points = random_points(random, count);
    const std::vector<PointRange> ranges = random_ranges(random, count);
    const TraversalPoint place = random_place(random);
    const Moments2 m = local_moments(PointColumns(points), ranges, place, kMomentsRadiusM);
    const Moments2 expected = one_by_one(points, ranges, place);
    ASSERT_EQ(m.count, expected.count);
    EXPECT_NEAR(m.w, expected.w, 1e-12);
    EXPECT_NEAR(m.x, expected.x, 1e-12);
    EXPECT_NEAR(m.y, expected.y, 1e-12);
    EXPECT_NEAR(m.xx, expected.xx, 1e-12);
    EXPECT_NEAR(m.xy, expected.xy, 1e-12);
    EXPECT_NEAR(m.yy, expected.yy, 1e-12);
    counted += m.count;
  }
  EXPECT_GT(counted, 500U);
}

TEST(LocalMoments, AreTheSameToTheLastBitOnAllMachines) {
  std::mt19937 random(92);
  for (int round = 0; round < 2000; ++round) {
    const auto count = static_cast<std::size_t>(random_int(random, 0, 400));
    const PointColumns points(random_points(random, count));
    const std::vector<PointRange> ranges = random_ranges(random, count);
    const TraversalPoint place = random_place(random);
    const Moments2 fast = local_moments(points, ranges, place, kMomentsRadiusM);
    const Moments2 portable = local_moments_portable(points, ranges, place, kMomentsRadiusM);
    ASSERT_EQ(fast.count, portable.count);
    ASSERT_EQ(fast.w, portable.w);
    ASSERT_EQ(fast.x, portable.x);
    ASSERT_EQ(fast.y, portable.y);
    ASSERT_EQ(fast.xx, portable.xx);
    ASSERT_EQ(fast.xy, portable.xy);
    ASSERT_EQ(fast.yy, portable.yy);
  }
}

TEST(LocalMoments, APointAtTheRadiusHasNoWeight) {
  const PointColumns points(
      std::vector<TraversalPoint>{{{0.5, 0.0}, 0}, {{std::nextafter(0.5, 0.0), 0.0}, 0}});
  const std::vector<PointRange> all{{0, 2}};
  EXPECT_EQ(local_moments(points, all, {{0.0, 0.0}, 1}, 0.5).count, 1U);
}

TEST(LocalMoments, TheLargestTraversalNumberIsOneLikeAnother) {
  constexpr std::uint32_t kLargest = std::numeric_limits<std::uint32_t>::max();
  const PointColumns points(std::vector<TraversalPoint>(5, TraversalPoint{{0.1, 0.0}, kLargest}));
  const std::vector<PointRange> all{{0, 5}};
  EXPECT_EQ(local_moments(points, all, {{0.0, 0.0}, kLargest}, kMomentsRadiusM).count, 0U);
  EXPECT_EQ(local_moments(points, all, {{0.0, 0.0}, kLargest - 1}, kMomentsRadiusM).count, 5U);
}

}  // namespace
}  // namespace swiftlet

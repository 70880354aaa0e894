// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/wall_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

constexpr double kWallRadiusM = 0.5;
constexpr double kSpacingM = 0.09;  // wider than a thinning cell: every point counts
constexpr std::uint32_t kAskingTraversal = 99;

/// `count` points from `first` on in a direction, all of one traversal.
std::vector<TraversalPoint> stretch(const Point2& first, double direction_rad, int count,
                                    std::uint32_t traversal) {
  std::vector<TraversalPoint> points(static_cast<std::size_t>(count), TraversalPoint{first, traversal});
  for (int i = 0; i < count; ++i) {
    Point2& p = points[static_cast<std::size_t>(i)].p_map;
    p.x_m += i * kSpacingM * std::cos(direction_rad);
    p.y_m += i * kSpacingM * std::sin(direction_rad);
  }
  return points;
}

/// Walls in all directions, and clutter, seen by several traversals.
std::vector<TraversalPoint> random_places(std::mt19937& random) {
  std::vector<TraversalPoint> points;
  for (std::uint32_t traversal = 0; traversal < 5; ++traversal) {
    for (int wall = 0; wall < 6; ++wall) {
      const Pose2 T_map_wall = random_pose(random, 3.0);
      for (int i = 0; i < 25; ++i)
        points.push_back(
            {T_map_wall * Point2{random_in(random, 0.0, 1.5), random_in(random, -0.04, 0.04)}, traversal});
    }
    for (int i = 0; i < 60; ++i)
      points.push_back({{random_in(random, -3.0, 3.0), random_in(random, -3.0, 3.0)}, traversal});
  }
  return points;
}

/// The slow twin: thins with a table, weighs every point there is, leaves the line to an eigensolver.
class AllPoints {
 public:
  explicit AllPoints(const std::vector<TraversalPoint>& points) {
    std::map<std::tuple<std::uint32_t, double, double>, std::vector<Eigen::Vector2d>> cells;
    for (const TraversalPoint& p : points)
      cells[{p.traversal, std::floor(p.p_map.x_m / 0.08), std::floor(p.p_map.y_m / 0.08)}].emplace_back(
          p.p_map.x_m, p.p_map.y_m);
    for (const auto& [key, members] : cells) {
      Eigen::Vector2d mean = Eigen::Vector2d::Zero();
      for (const Eigen::Vector2d& p : members) mean += p / static_cast<double>(members.size());
      thinned_.emplace_back(std::get<0>(key), mean);
    }
  }

  [[nodiscard]] std::size_t size() const { return thinned_.size(); }

  [[nodiscard]] std::optional<LocalWall> wall_near(const TraversalPoint& place) const {
    const Eigen::Vector2d at(place.p_map.x_m, place.p_map.y_m);
    std::vector<std::pair<double, Eigen::Vector2d>> near;
    double sum = 0.0;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& [traversal, p] : thinned_) {
      const double weight = 1.0 - (p - at).squaredNorm() / (kWallRadiusM * kWallRadiusM);
      if (traversal == place.traversal || weight <= 0.0) continue;
      near.emplace_back(weight, p);
      mean += weight * p;
      sum += weight;
    }
    const WallFitTuning fit;
    if (near.size() < fit.min_points) return std::nullopt;
    mean /= sum;
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    for (const auto& [weight, p] : near) scatter += weight / sum * (p - mean) * (p - mean).transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
    axes.computeDirect(scatter);
    const double across = axes.eigenvalues()[0];
    const double along = axes.eigenvalues()[1];
    if (along < fit.min_variance_m2 || across > fit.max_variance_ratio * along) return std::nullopt;
    const Eigen::Vector2d normal = axes.eigenvectors().col(0);
    return LocalWall{{mean.x(), mean.y()}, {normal.x(), normal.y()}};
  }

 private:
  std::vector<std::pair<std::uint32_t, Eigen::Vector2d>> thinned_;
};

TEST(WallMap, EqualsTheSearchThroughAllPoints) {
  std::mt19937 random(81);
  std::size_t walls = 0;
  std::size_t none = 0;
  for (int round = 0; round < 10; ++round) {
    const std::vector<TraversalPoint> points = random_places(random);
    const WallMap map(points, kWallRadiusM);
    const AllPoints twin(points);
    ASSERT_EQ(map.size(), twin.size());
    for (int query = 0; query < 300; ++query) {
      const Point2 p{random_in(random, -5.0, 5.0), random_in(random, -5.0, 5.0)};
      const TraversalPoint place{p, static_cast<std::uint32_t>(random_int(random, 0, 5))};
      const auto wall = map.wall_near(place);
      const auto expected = twin.wall_near(place);
      ASSERT_EQ(wall.has_value(), expected.has_value());
      ++(wall ? walls : none);
      if (!wall) continue;
      EXPECT_NEAR(wall->center_map.x_m, expected->center_map.x_m, 1e-9);
      EXPECT_NEAR(wall->center_map.y_m, expected->center_map.y_m, 1e-9);
      const double cross =
          wall->normal_map.x_m * expected->normal_map.y_m - wall->normal_map.y_m * expected->normal_map.x_m;
      EXPECT_NEAR(cross, 0.0, 1e-6) << "the same line, whichever way its normal points";
    }
  }
  EXPECT_GT(walls, 300U);
  EXPECT_GT(none, 300U);
}

TEST(WallMap, PointsThatAreThinnedAlreadyCountTheSame) {
  std::mt19937 random(82);
  const std::vector<TraversalPoint> points = random_places(random);
  const auto later =
      std::find_if(points.begin(), points.end(), [](const TraversalPoint& p) { return p.traversal == 3; });
  std::vector<TraversalPoint> thinned;
  append_thinned(std::vector<TraversalPoint>(points.begin(), later), RefinementTuning{}.thinning_cell_m,
                 thinned);
  const WallMap of_both(thinned, std::vector<TraversalPoint>(later, points.end()), kWallRadiusM);
  const WallMap of_all(points, kWallRadiusM);
  ASSERT_EQ(of_both.size(), of_all.size());
  EXPECT_LT(of_all.size(), points.size());
  for (int query = 0; query < 300; ++query) {
    const TraversalPoint place{{random_in(random, -3.0, 3.0), random_in(random, -3.0, 3.0)},
                               kAskingTraversal};
    const auto wall = of_both.wall_near(place);
    const auto expected = of_all.wall_near(place);
    ASSERT_EQ(wall.has_value(), expected.has_value());
    if (!wall) continue;
    EXPECT_EQ(wall->center_map.x_m, expected->center_map.x_m);
    EXPECT_EQ(wall->center_map.y_m, expected->center_map.y_m);
  }
}

TEST(WallMap, TheNormalStandsAcrossTheWallInEveryDirection) {
  for (int i = 0; i < 24; ++i) {
    const double direction_rad = i * kPi / 12.0;
    const WallMap map(stretch({2.0, -3.0}, direction_rad, 9, 0), kWallRadiusM);
    const double middle_m = 4.0 * kSpacingM;
    const Point2 middle{2.0 + middle_m * std::cos(direction_rad), -3.0 + middle_m * std::sin(direction_rad)};
    const Point2 beside{middle.x_m - 0.1 * std::sin(direction_rad),
                        middle.y_m + 0.1 * std::cos(direction_rad)};
    const auto wall = map.wall_near({beside, kAskingTraversal});
    ASSERT_TRUE(wall) << i;
    EXPECT_NEAR(wall->center_map.x_m, middle.x_m, 1e-9);
    EXPECT_NEAR(wall->center_map.y_m, middle.y_m, 1e-9);
    EXPECT_NEAR(std::hypot(wall->normal_map.x_m, wall->normal_map.y_m), 1.0, 1e-12);
    EXPECT_NEAR(
        wall->normal_map.x_m * std::cos(direction_rad) + wall->normal_map.y_m * std::sin(direction_rad), 0.0,
        1e-9);
  }
}

TEST(WallMap, NearPointsCountMore) {
  // Two parallel walls; closer to the lower one the line leans to it.
  std::vector<TraversalPoint> points = stretch({-0.36, 0.0}, 0.0, 9, 0);
  const std::vector<TraversalPoint> upper = stretch({-0.36, 0.1}, 0.0, 9, 1);
  points.insert(points.end(), upper.begin(), upper.end());
  const WallMap map(points, kWallRadiusM);
  const auto at_lower = map.wall_near({{0.0, -0.2}, kAskingTraversal});
  const auto at_upper = map.wall_near({{0.0, 0.3}, kAskingTraversal});
  ASSERT_TRUE(at_lower && at_upper);
  EXPECT_LT(at_lower->center_map.y_m, 0.049);
  EXPECT_GT(at_upper->center_map.y_m, 0.051);
}

TEST(WallMap, APassDoesNotSeeItsOwnReturns) {
  std::vector<TraversalPoint> points = stretch({0.0, 0.0}, 0.0, 9, 0);
  const Point2 place{0.36, 0.05};
  EXPECT_FALSE(WallMap(points, kWallRadiusM).wall_near({place, 0}));
  const std::vector<TraversalPoint> other = stretch({0.0, 0.2}, 0.0, 9, 1);
  points.insert(points.end(), other.begin(), other.end());
  const WallMap map(points, kWallRadiusM);
  const auto of_0 = map.wall_near({place, 0});
  const auto of_1 = map.wall_near({place, 1});
  ASSERT_TRUE(of_0 && of_1);
  EXPECT_NEAR(of_0->center_map.y_m, 0.2, 1e-12) << "traversal 1 draws it there";
  EXPECT_NEAR(of_1->center_map.y_m, 0.0, 1e-12) << "traversal 0 draws it there";
}

TEST(WallMap, FewerThanFivePointsAreNoWall) {
  const Point2 place{0.2, 0.0};
  EXPECT_FALSE(WallMap(stretch({0.0, 0.0}, 0.0, 4, 0), kWallRadiusM).wall_near({place, kAskingTraversal}));
  EXPECT_TRUE(WallMap(stretch({0.0, 0.0}, 0.0, 5, 0), kWallRadiusM).wall_near({place, kAskingTraversal}));
}

TEST(WallMap, ClutterIsNoWall) {
  std::vector<TraversalPoint> block;
  for (std::uint32_t row = 0; row < 9; ++row) {
    const std::vector<TraversalPoint> line = stretch({-0.36, kSpacingM * row - 0.36}, 0.0, 9, row);
    block.insert(block.end(), line.begin(), line.end());
  }
  EXPECT_FALSE(WallMap(block, kWallRadiusM).wall_near({{0.0, 0.0}, kAskingTraversal}));
}

TEST(WallMap, AShortStretchHasNoDirection) {
  // Many traversals that each saw the same post.
  std::vector<TraversalPoint> post(20);
  for (std::uint32_t traversal = 0; traversal < 20; ++traversal)
    post[traversal] = {{1.0 + 0.008 * traversal, 1.0}, traversal};
  EXPECT_FALSE(WallMap(post, kWallRadiusM).wall_near({{1.08, 1.0}, kAskingTraversal}));
  for (TraversalPoint& p : post) p.p_map.x_m = 1.0 + 0.016 * p.traversal;
  EXPECT_TRUE(WallMap(post, kWallRadiusM).wall_near({{1.16, 1.0}, kAskingTraversal})) << "long enough";
}

TEST(WallMap, WallsBeyondTheRadiusAreNotNear) {
  const WallMap map(stretch({0.0, 0.0}, 0.0, 12, 0), kWallRadiusM);
  EXPECT_TRUE(map.wall_near({{0.5, 0.3}, kAskingTraversal}));
  EXPECT_FALSE(map.wall_near({{0.5, 0.5}, kAskingTraversal}));
}

TEST(WallMap, FarOutsideThereIsNothing) {
  const WallMap map(stretch({0.0, 0.0}, 0.5, 40, 0), kWallRadiusM);
  for (const double x_m : {-1e4, -2.0, 1.0, 20.0, 1e4}) {
    for (const double y_m : {-1e4, -2.0, 20.0, 1e4})
      EXPECT_FALSE(map.wall_near({{x_m, y_m}, kAskingTraversal})) << x_m << ", " << y_m;
  }
}

TEST(WallMap, AnEmptyMapHasNoWalls) {
  const WallMap map({}, kWallRadiusM);
  EXPECT_EQ(map.size(), 0U);
  EXPECT_FALSE(map.wall_near({{0.0, 0.0}, 0}));
}

TEST(WallMap, KeepsOnePointAPassAndCellInTheirMiddle) {
  // A vehicle that hovers draws the first point a hundred times over: it weighs no more than the others.
  std::vector<TraversalPoint> points(50, TraversalPoint{{0.02, 0.01}, 0});
  points.insert(points.end(), 50, TraversalPoint{{0.02, 0.03}, 0});
  for (int i = 1; i < 9; ++i) points.push_back({{0.02 + 0.08 * i, 0.02}, 0});
  points.push_back({{0.02, 0.02}, 1});
  const WallMap map(points, kWallRadiusM);
  EXPECT_EQ(map.size(), 10U);
  const auto wall = map.wall_near({{0.34, 0.02}, 1});
  ASSERT_TRUE(wall);
  EXPECT_NEAR(wall->center_map.x_m, 0.34, 1e-9);
  EXPECT_NEAR(wall->center_map.y_m, 0.02, 1e-9);
}

}  // namespace
}  // namespace swiftlet

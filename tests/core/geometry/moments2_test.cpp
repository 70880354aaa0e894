// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/geometry/moments2.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <vector>

#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

constexpr int kMomentsDraws = 200;

struct Weighted {
  Point2 p;
  double weight = 1.0;
};

std::vector<Weighted> drawn(std::mt19937& random) {
  std::vector<Weighted> points(12);
  for (Weighted& at : points)
    at = {{random_in(random, -1.0, 2.0), random_in(random, -0.5, 1.5)}, random_in(random, 0.1, 1.0)};
  return points;
}

Moments2 moments_of(const std::vector<Weighted>& points) {
  Moments2 moments;
  for (const Weighted& at : points) moments.add(at.p, at.weight);
  return moments;
}

TEST(Moments2, ScatterAgreesWithTheWeightedCovariance) {
  std::mt19937 random(1);
  for (int draw = 0; draw < kMomentsDraws; ++draw) {
    const std::vector<Weighted> points = drawn(random);
    double weight = 0.0;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Weighted& at : points) {
      weight += at.weight;
      mean += at.weight * Eigen::Vector2d(at.p.x_m, at.p.y_m);
    }
    mean /= weight;
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
    for (const Weighted& at : points) {
      const Eigen::Vector2d off = Eigen::Vector2d(at.p.x_m, at.p.y_m) - mean;
      covariance += at.weight / weight * off * off.transpose();
    }
    const Scatter2 scatter = moments_of(points).scatter();
    EXPECT_NEAR(scatter.mean.x_m, mean(0), 1e-12);
    EXPECT_NEAR(scatter.mean.y_m, mean(1), 1e-12);
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
    eigen.computeDirect(covariance);
    EXPECT_NEAR(scatter.across(), eigen.eigenvalues()(0), 1e-12);
    EXPECT_NEAR(scatter.along(), eigen.eigenvalues()(1), 1e-12);
    const Point2 normal = scatter.normal();
    EXPECT_NEAR(std::abs(eigen.eigenvectors().col(0).dot(Eigen::Vector2d(normal.x_m, normal.y_m))), 1.0,
                1e-12);
  }
}

TEST(Moments2, OfTwoSetsAreThoseOfTheirUnion) {
  std::mt19937 random(2);
  const std::vector<Weighted> points = drawn(random);
  Moments2 first = moments_of({points.begin(), points.begin() + 5});
  first.merge(moments_of({points.begin() + 5, points.end()}));
  const Moments2 all = moments_of(points);
  EXPECT_EQ(first.count, all.count);
  EXPECT_NEAR(first.w, all.w, 1e-12);
  EXPECT_NEAR(first.scatter().along(), all.scatter().along(), 1e-12);
  EXPECT_NEAR(first.scatter().across(), all.scatter().across(), 1e-12);
}

TEST(Scatter2, NormalsOfLinesAlongTheAxesAreExact) {
  EXPECT_EQ(std::abs((Scatter2{{}, 2.0, 0.0, 0.0}.normal().y_m)), 1.0);
  EXPECT_EQ((Scatter2{{}, 2.0, 0.0, 0.0}.normal().x_m), 0.0);
  EXPECT_EQ(std::abs((Scatter2{{}, 0.0, 0.0, 2.0}.normal().x_m)), 1.0);
  EXPECT_EQ((Scatter2{{}, 0.0, 0.0, 2.0}.normal().y_m), 0.0);
}

TEST(Scatter2, PointsWithoutADirectionHaveANormalNevertheless) {
  Moments2 moments;
  for (int i = 0; i < 3; ++i) moments.add({0.25, 0.5});
  EXPECT_EQ(moments.scatter().normal().x_m, 1.0);
  EXPECT_EQ(moments.scatter().normal().y_m, 0.0);
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/line_fit.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/numeric_jacobian.hpp"
#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

constexpr int kFitDraws = 200;

std::vector<Point2> noisy_points(const Line2& line, double sigma_m, test::RandomGeometry& random) {
  std::vector<Point2> points;
  for (int i = 0; i < 12; ++i) {
    const Point2 p = line.point_at(-1.0 + 0.2 * i);
    points.push_back({p.x_m + random.normal(sigma_m), p.y_m + random.normal(sigma_m)});
  }
  return points;
}

LineFit fit_of(const std::vector<Point2>& points) {
  LineFit fit;
  for (const Point2& p : points) fit.add(p);
  return fit;
}

TEST(LineFit, GoesThroughPointsThatLieOnALine) {
  test::RandomGeometry random(1);
  for (int i = 0; i < kFitDraws; ++i) {
    const Line2 line = random.line();
    const LineFit fit = fit_of(noisy_points(line, 0.0, random));
    EXPECT_NEAR(fit.line().rho_m, line.rho_m, 1e-9);
    EXPECT_NEAR(wrap_angle(fit.line().alpha_rad - line.alpha_rad), 0.0, 1e-9);
    EXPECT_NEAR(fit.rms_m(), 0.0, 1e-6);
  }
}

TEST(LineFit, MinimisesTheSquaredDistances) {
  test::RandomGeometry random(2);
  for (int i = 0; i < kFitDraws; ++i) {
    const std::vector<Point2> points = noisy_points(random.line(), 0.05, random);
    const auto sum_of_squares = [&](const Line2& line) {
      double sum = 0.0;
      for (const Point2& p : points) sum += line.distance_m(p) * line.distance_m(p);
      return sum;
    };
    const LineFit fit = fit_of(points);
    const double best = sum_of_squares(fit.line());
    EXPECT_NEAR(fit.rms_m(), std::sqrt(best / 12.0), 1e-9);
    for (const double d : {-1e-3, 1e-3}) {
      EXPECT_GT(sum_of_squares({fit.line().rho_m + d, fit.line().alpha_rad}), best);
      EXPECT_GT(sum_of_squares({fit.line().rho_m, fit.line().alpha_rad + d}), best);
    }
  }
}

TEST(LineFit, OfTwoSetsIsTheFitOfTheirUnion) {
  test::RandomGeometry random(3);
  const std::vector<Point2> points = noisy_points(random.line(), 0.05, random);
  LineFit first = fit_of({points.begin(), points.begin() + 5});
  first.add(fit_of({points.begin() + 5, points.end()}));
  EXPECT_EQ(first.count(), points.size());
  EXPECT_NEAR(first.line().rho_m, fit_of(points).line().rho_m, 1e-12);
  EXPECT_NEAR(first.line().alpha_rad, fit_of(points).line().alpha_rad, 1e-12);
}

TEST(LineFit, JacobianAgreesWithCentralDifferences) {
  test::RandomGeometry random(4);
  int checked = 0;
  for (int draw = 0; draw < kFitDraws; ++draw) {
    std::vector<Point2> points = noisy_points(random.line(), 0.05, random);
    const Line2 line = fit_of(points).line();
    if (std::abs(line.alpha_rad) > 3.1 || line.rho_m < 0.01) continue;  // seams
    ++checked;
    const std::size_t k = static_cast<std::size_t>(draw) % points.size();
    const Point2 at = points[k];
    const auto fitted = [&](const Eigen::Vector2d& v) {
      points[k] = {v(0), v(1)};
      const Line2 moved = fit_of(points).line();
      return Eigen::Vector2d(moved.rho_m, moved.alpha_rad);
    };
    const Eigen::Matrix2d expected = test::numeric_jacobian<2, 2>(fitted, Eigen::Vector2d(at.x_m, at.y_m));
    points[k] = at;
    EXPECT_TRUE(fit_of(points).jacobian(line, at).isApprox(expected, 1e-6));
  }
  EXPECT_GT(checked, kFitDraws / 2);
}

}  // namespace
}  // namespace swiftlet

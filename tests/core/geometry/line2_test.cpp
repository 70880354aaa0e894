// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/geometry/line2.hpp"

#include <gtest/gtest.h>

#include "tests/support/numeric_jacobian.hpp"
#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

using test::numeric_jacobian;
using test::pose_of;

constexpr int kLineDraws = 1000;

TEST(Line2, FootIsThePointNearestToTheOrigin) {
  const Line2 line{2.0, kPi / 2.0};
  EXPECT_NEAR(line.foot().x_m, 0.0, 1e-12);
  EXPECT_NEAR(line.foot().y_m, 2.0, 1e-12);
}

TEST(Line2, PlacesPointsAlongItselfAsItMeasuresThem) {
  test::RandomGeometry random(1);
  for (int i = 0; i < kLineDraws; ++i) {
    const Line2 line = random.line();
    const double t_m = random.uniform(-5.0, 5.0);
    const Point2 p = line.point_at(t_m);
    EXPECT_NEAR(line.along_m(p), t_m, 1e-12);
    EXPECT_NEAR(line.distance_m(p), 0.0, 1e-12);
  }
}

TEST(Line2, NormalizingKeepsTheLine) {
  test::RandomGeometry random(2);
  for (int i = 0; i < kLineDraws; ++i) {
    const Line2 line{random.uniform(-5.0, 5.0), random.uniform(-10.0, 10.0)};
    const Line2 normal = line.normalized();
    EXPECT_GE(normal.rho_m, 0.0);
    EXPECT_NEAR(normal.distance_m(line.point_at(1.7)), 0.0, 1e-12);
    EXPECT_NEAR(normal.distance_m(line.foot()), 0.0, 1e-12);
  }
}

TEST(TransformLine, MovesTheLineWithItsPoints) {
  test::RandomGeometry random(3);
  for (int i = 0; i < kLineDraws; ++i) {
    const Pose2 T_b_a = random.pose();
    const Line2 line_a = random.line();
    const TransformedLine moved = transform_line(T_b_a, line_a);
    EXPECT_GE(moved.line_b.rho_m, 0.0);
    for (const double t_m : {-3.0, 0.0, 2.0})
      EXPECT_NEAR(moved.line_b.distance_m(T_b_a * line_a.point_at(t_m)), 0.0, 1e-11);
  }
}

TEST(TransformLine, JacobiansAgreeWithCentralDifferencesOnBothSidesOfTheFlip) {
  test::RandomGeometry random(4);
  int flipped = 0;
  for (int i = 0; i < kLineDraws; ++i) {
    const Pose2 T_b_a = random.pose();
    const Line2 line_a = random.line();
    const TransformedLine moved = transform_line(T_b_a, line_a);
    if (moved.line_b.rho_m < 1e-3 || std::abs(moved.line_b.alpha_rad) > 3.1) continue;  // seams
    flipped += moved.flipped ? 1 : 0;
    const auto vector_of = [](const Line2& l) { return Eigen::Vector2d(l.rho_m, l.alpha_rad); };
    const auto of_pose = [&](const Eigen::Vector3d& v) {
      return vector_of(transform_line(pose_of(v), line_a).line_b);
    };
    const auto of_line = [&](const Eigen::Vector2d& v) {
      return vector_of(transform_line(T_b_a, Line2{v(0), v(1)}).line_b);
    };
    EXPECT_TRUE(moved.J_pose.isApprox(numeric_jacobian<2, 3>(of_pose, T_b_a.vector()), 1e-7));
    EXPECT_TRUE(moved.J_line.isApprox(numeric_jacobian<2, 2>(of_line, vector_of(line_a)), 1e-7));
  }
  EXPECT_GT(flipped, kLineDraws / 10);
}

}  // namespace
}  // namespace swiftlet

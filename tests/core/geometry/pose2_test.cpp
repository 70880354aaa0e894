// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/geometry/pose2.hpp"

#include <gtest/gtest.h>

#include "tests/support/numeric_jacobian.hpp"
#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

using test::numeric_jacobian;
using test::pose_of;

constexpr int kPoseDraws = 1000;

void expect_near(const Pose2& a, const Pose2& b) {
  EXPECT_NEAR(a.x_m(), b.x_m(), 1e-12);
  EXPECT_NEAR(a.y_m(), b.y_m(), 1e-12);
  EXPECT_NEAR(wrap_angle(a.yaw_rad() - b.yaw_rad()), 0.0, 1e-12);
}

TEST(Pose2, TurnsCounterClockwiseThenMoves) {
  const Point2 p = Pose2(1.0, 2.0, kPi / 2.0) * Point2{3.0, 0.0};
  EXPECT_NEAR(p.x_m, 1.0, 1e-12);
  EXPECT_NEAR(p.y_m, 5.0, 1e-12);
}

TEST(Pose2, IsAGroup) {
  test::RandomGeometry random(1);
  for (int i = 0; i < kPoseDraws; ++i) {
    const Pose2 a = random.pose();
    const Pose2 b = random.pose();
    const Pose2 c = random.pose();
    expect_near((a * b) * c, a * (b * c));
    expect_near(a * a.inverse(), Pose2());
    expect_near(a.inverse() * a, Pose2());
    expect_near(a * Pose2(), a);
    expect_near((a * b).inverse(), b.inverse() * a.inverse());
  }
}

TEST(Pose2, ActsOnPointsAsTheGroupComposes) {
  test::RandomGeometry random(2);
  for (int i = 0; i < kPoseDraws; ++i) {
    const Pose2 a = random.pose();
    const Pose2 b = random.pose();
    const Point2 p = random.point();
    const Point2 at_once = (a * b) * p;
    const Point2 in_turn = a * (b * p);
    EXPECT_NEAR(at_once.x_m, in_turn.x_m, 1e-12);
    EXPECT_NEAR(at_once.y_m, in_turn.y_m, 1e-12);
  }
}

TEST(Pose2, BetweenLeadsFromTheFirstToTheSecond) {
  test::RandomGeometry random(3);
  for (int i = 0; i < kPoseDraws; ++i) {
    const Pose2 a = random.pose();
    const Pose2 b = random.pose();
    expect_near(a * between(a, b), b);
  }
}

TEST(Pose2, JacobiansAgreeWithCentralDifferences) {
  test::RandomGeometry random(4);
  for (int i = 0; i < kPoseDraws; ++i) {
    const Pose2 a = random.pose();
    Pose2 b = random.pose();
    // Away from the seam of the angle, where differences of wrapped values mean nothing.
    if (std::abs((a * b).yaw_rad()) > 3.1) b = b * Pose2(0.0, 0.0, 0.2);
    const auto of_first = [&](const Eigen::Vector3d& v) { return (pose_of(v) * b).vector(); };
    const auto of_second = [&](const Eigen::Vector3d& v) { return (a * pose_of(v)).vector(); };
    const auto of_inverse = [](const Eigen::Vector3d& v) { return pose_of(v).inverse().vector(); };
    EXPECT_TRUE(jacobian_compose_first(a, b).isApprox(numeric_jacobian<3, 3>(of_first, a.vector()), 1e-7));
    EXPECT_TRUE(jacobian_compose_second(a).isApprox(numeric_jacobian<3, 3>(of_second, b.vector()), 1e-7));
    EXPECT_TRUE(jacobian_inverse(a).isApprox(numeric_jacobian<3, 3>(of_inverse, a.vector()), 1e-7));
  }
}

}  // namespace
}  // namespace swiftlet

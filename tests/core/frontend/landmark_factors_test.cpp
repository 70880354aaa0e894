// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/landmark_factors.hpp"

#include <gtest/gtest.h>

#include "tests/support/numeric_jacobian.hpp"
#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

using test::numeric_jacobian;
using test::pose_of;

constexpr int kFactorDraws = 1000;

Pose2 nearly(const Pose2& pose, test::RandomGeometry& random) {
  return pose * Pose2(random.normal(0.1), random.normal(0.1), random.normal(0.1));
}

TEST(LineError, IsNoneForTheLineAsSeenFromThePose) {
  test::RandomGeometry random(3);
  for (int i = 0; i < kFactorDraws; ++i) {
    const Pose2 pose = random.pose();
    const Line2 line = random.line();
    EXPECT_LT(line_error(transform_line(pose.inverse(), line).line_b, pose, line).error.norm(), 1e-11);
  }
}

TEST(LineError, JacobiansAgreeWithCentralDifferences) {
  test::RandomGeometry random(4);
  for (int i = 0; i < kFactorDraws; ++i) {
    const Pose2 pose = random.pose();
    const Line2 line{random.uniform(-5.0, 5.0), random.uniform(-kPi, kPi)};
    const Line2 seen = transform_line(nearly(pose, random).inverse(), line).line_b;
    const LineError at = line_error(seen, pose, line);
    if (std::abs(at.error(1)) > 1.5) continue;  // the normals are about to be taken the other way round
    const auto of_pose = [&](const Eigen::Vector3d& v) { return line_error(seen, pose_of(v), line).error; };
    const auto of_line = [&](const Eigen::Vector2d& v) {
      return line_error(seen, pose, Line2{v(0), v(1)}).error;
    };
    EXPECT_TRUE(at.J_pose.isApprox(numeric_jacobian<2, 3>(of_pose, pose.vector()), 1e-6));
    EXPECT_TRUE(at.J_line.isApprox(
        numeric_jacobian<2, 2>(of_line, Eigen::Vector2d(line.rho_m, line.alpha_rad)), 1e-6));
  }
}

TEST(LineError, StaysSmallWhenTheExtensionOfAWallPassesTheVehicleOnTheOtherSide) {
  const Line2 wall{1.0, 0.0};
  const Line2 seen_from_before_it{0.02, 0.0};
  const Pose2 just_beyond_it(1.03, 0.0, 0.0);
  const LineError at = line_error(seen_from_before_it, just_beyond_it, wall);
  EXPECT_NEAR(at.error(0), 0.05, 1e-12);
  EXPECT_NEAR(at.error(1), 0.0, 1e-12);
}

}  // namespace
}  // namespace swiftlet

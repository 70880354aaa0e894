// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/geometry/pose_residual.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/support/numeric_jacobian.hpp"
#include "tests/support/random_draws.hpp"
#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

using test::numeric_jacobian;
using test::pose_of;

constexpr int kDraws = 1000;

TEST(PoseResidual, IsNoneWhereThePosesAreWhereTheMotionLeads) {
  test::RandomGeometry random(1);
  for (int i = 0; i < kDraws; ++i) {
    const Pose2 from = random.pose();
    const Pose2 motion = random.pose();
    EXPECT_LT(pose_residual(motion, from, from * motion).error.norm(), 1e-12);
  }
}

TEST(PoseResidual, IsTheMissingStepInTheFrameOfTheLaterPose) {
  const Pose2 T_from_to(2.0, 0.0, kPi / 2.0);
  // `to` stands 0.1 m too far along the x of `from`: to its own right, which is -y.
  const PoseResidual r = pose_residual(T_from_to, Pose2(), Pose2(2.1, 0.0, kPi / 2.0 + 0.01));
  EXPECT_NEAR(r.error[0], 0.0, 1e-12);
  EXPECT_NEAR(r.error[1], -0.1, 1e-12);
  EXPECT_NEAR(r.error[2], 0.01, 1e-12);
}

/// Errors of yaw below a half turn: beyond it they jump.
TEST(PoseResidual, JacobiansAgreeWithCentralDifferences) {
  test::RandomGeometry random(2);
  for (int i = 0; i < kDraws; ++i) {
    const Pose2 from = random.pose();
    const Pose2 motion = random.pose();
    const Pose2 to = from * motion * Pose2(random.normal(2.0), random.normal(2.0), random.uniform(-3.1, 3.1));
    const PoseResidual at = pose_residual(motion, from, to);
    const auto of_from = [&](const Eigen::Vector3d& v) {
      return pose_residual(motion, pose_of(v), to).error;
    };
    const auto of_to = [&](const Eigen::Vector3d& v) {
      return pose_residual(motion, from, pose_of(v)).error;
    };
    EXPECT_TRUE(at.J_from.isApprox(numeric_jacobian<3, 3>(of_from, from.vector()), 1e-6));
    EXPECT_TRUE(at.J_to.isApprox(numeric_jacobian<3, 3>(of_to, to.vector()), 1e-6));
  }
}

TEST(ResidualInformation, TurnsTheCovarianceIntoTheFrameOfTheLaterPose) {
  // `to` looks along the y of `from`: what is uncertain along y of `from` is so along x of `to`.
  const Eigen::Matrix3d covariance = Eigen::Vector3d(1.0, 4.0, 0.25).asDiagonal();
  const Eigen::Matrix3d information = residual_information(Pose2(3.0, -1.0, kPi / 2.0), covariance);
  const Eigen::Matrix3d expected = Eigen::Vector3d(0.25, 1.0, 4.0).asDiagonal();
  EXPECT_LT((information - expected).norm(), 1e-12);
}

TEST(ResidualInformation, IsWhatErrorPropagationThroughTheResidualGives) {
  std::mt19937 random(33);
  for (int i = 0; i < kDraws; ++i) {
    const Pose2 motion = random_pose(random, 5.0);
    const Eigen::Matrix3d covariance = random_covariance(random, 0.1);
    const auto error = [&](const Eigen::Vector3d& v) {
      return pose_residual(motion, Pose2(), pose_of(v)).error;
    };
    const Eigen::Matrix3d J = numeric_jacobian<3, 3>(error, motion.vector());
    const Eigen::Matrix3d expected = (J * covariance * J.transpose()).inverse();
    ASSERT_LT((residual_information(motion, covariance) - expected).norm(), 1e-6 * expected.norm());
  }
}

}  // namespace
}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/pose_graph.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "tests/support/central_differences.hpp"
#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

constexpr int kDraws = 1000;

TEST(PoseResidual, VanishesWhereThePosesAgreeWithTheMeasurement) {
  std::mt19937 random(31);
  for (int i = 0; i < kDraws; ++i) {
    const Pose2 T_map_from = random_pose(random, 20.0);
    const Pose2 T_from_to = random_pose(random, 5.0);
    EXPECT_LT(pose_residual(T_from_to, T_map_from, T_map_from * T_from_to).error.norm(), 1e-12);
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

TEST(PoseResidual, JacobiansEqualCentralDifferencesAtRandomStates) {
  std::mt19937 random(32);
  for (int i = 0; i < kDraws; ++i) {
    const Pose2 T_from_to = random_pose(random, 5.0);
    const Pose2 T_map_from = random_pose(random, 5.0);
    const Pose2 T_map_to = random_pose(random, 5.0);
    const PoseResidual r = pose_residual(T_from_to, T_map_from, T_map_to);
    const Eigen::Matrix3d J_from = central_differences(
        [&](const Eigen::Vector3d& v) { return pose_residual(T_from_to, pose_of(v), T_map_to).error; },
        T_map_from.vector());
    const Eigen::Matrix3d J_to = central_differences(
        [&](const Eigen::Vector3d& v) { return pose_residual(T_from_to, T_map_from, pose_of(v)).error; },
        T_map_to.vector());
    ASSERT_LT((r.J_from - J_from).cwiseAbs().maxCoeff(), 1e-7) << "draw " << i;
    ASSERT_LT((r.J_to - J_to).cwiseAbs().maxCoeff(), 1e-7) << "draw " << i;
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
    const Pose2 T_from_to = random_pose(random, 5.0);
    const Eigen::Matrix3d covariance = random_covariance(random, 0.1);
    const Eigen::Matrix3d J = central_differences(
        [&](const Eigen::Vector3d& v) { return pose_residual(T_from_to, Pose2(), pose_of(v)).error; },
        T_from_to.vector());
    const Eigen::Matrix3d expected = (J * covariance * J.transpose()).inverse();
    ASSERT_LT((residual_information(T_from_to, covariance) - expected).norm(), 1e-6 * expected.norm());
  }
}

TEST(DcsScale, FollowsItsEquation) {
  EXPECT_DOUBLE_EQ(dcs_scale(0.0, 5.0), 1.0);
  EXPECT_DOUBLE_EQ(dcs_scale(5.0, 5.0), 1.0);
  EXPECT_DOUBLE_EQ(dcs_scale(10.0, 5.0), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(dcs_scale(45.0, 5.0), 0.2);
  EXPECT_DOUBLE_EQ(dcs_scale(3.0, 1.0), 0.5);
}

TEST(DcsScale, FallsSteadilyBeyondPhi) {
  for (int i = 0; i < 20; ++i) {
    const double chi_square = 5.0 * std::pow(2.0, i);
    EXPECT_LT(dcs_scale(2.0 * chi_square, 5.0), dcs_scale(chi_square, 5.0));
    EXPECT_GT(dcs_scale(chi_square, 5.0), 0.0);
  }
}

}  // namespace
}  // namespace swiftlet

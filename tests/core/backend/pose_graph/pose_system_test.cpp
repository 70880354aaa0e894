// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/pose_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "core/geometry/pose_residual.hpp"
#include "tests/support/pose_near.hpp"
#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;

/// Where the unknowns of a pose begin.
Eigen::Index row_of(std::size_t pose) { return 3 * static_cast<Eigen::Index>(pose); }

/// What pulls at one pose alone.
struct Pull {
  std::uint32_t pose = 0;
  Eigen::Matrix3d H;
  Eigen::Vector3d rhs;
};

struct Problem {
  std::vector<Pose2> T_map_pose;
  std::vector<RelativePoseFactor<PoseIndex>> factors;
  std::vector<double> weights;  // of the factors
  std::vector<Pull> pulls;
};

PoseIndex pose_index(std::size_t pose) { return make_id<PoseIndex>(pose); }

/// A chain of poses, joined in both directions, with a few closures, and pulls at some.
Problem random_problem(std::mt19937& random, std::uint32_t poses) {
  Problem problem;
  for (std::uint32_t i = 0; i < poses; ++i) problem.T_map_pose.push_back(random_pose(random, 4.0));
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    const bool forward = random_int(random, 0, 1) == 0;
    RelativePoseFactor<PoseIndex> c;
    c.from = pose_index(forward ? a : b);
    c.to = pose_index(forward ? b : a);
    c.T_from_to = between(problem.T_map_pose[index_of(c.from)], problem.T_map_pose[index_of(c.to)]) *
                  random_pose(random, 0.1);
    c.information = random_covariance(random, 0.5);
    problem.factors.push_back(c);
    problem.weights.push_back(random_in(random, 0.1, 2.0));
  };
  for (std::uint32_t i = 1; i < poses; ++i) join(i - 1, i);
  for (std::uint32_t i = 2; i < poses; i += 3)
    join(static_cast<std::uint32_t>(random_int(random, 0, static_cast<int>(i) - 1)), i);
  for (std::uint32_t i = 0; i < poses; i += 2)
    problem.pulls.push_back({i, random_covariance(random, 0.0), 3.0 * random_pose(random, 1.0).vector()});
  return problem;
}

void fill(PoseSystem& system, const Problem& problem) {
  system.set_zero();
  for (std::size_t i = 0; i < problem.factors.size(); ++i)
    system.add(problem.factors[i], problem.weights[i], problem.T_map_pose);
  for (const Pull& pull : problem.pulls) system.add(pose_index(pull.pose), pull.H, pull.rhs);
}

/// The slow twin: all Jacobians of all poses as one dense matrix, the first pose's columns left out.
std::vector<Pose2> dense_step(const Problem& problem) {
  const auto n = row_of(problem.T_map_pose.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n);
  for (std::size_t k = 0; k < problem.factors.size(); ++k) {
    const RelativePoseFactor<PoseIndex>& c = problem.factors[k];
    const PoseResidual r =
        pose_residual(c.T_from_to, problem.T_map_pose[index_of(c.from)], problem.T_map_pose[index_of(c.to)]);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, n);
    J.middleCols<3>(row_of(index_of(c.from))) = r.J_from;
    J.middleCols<3>(row_of(index_of(c.to))) = r.J_to;
    H += problem.weights[k] * J.transpose() * c.information * J;
    rhs -= problem.weights[k] * J.transpose() * c.information * r.error;
  }
  for (const Pull& pull : problem.pulls) {
    H.block<3, 3>(row_of(pull.pose), row_of(pull.pose)) += pull.H;
    rhs.segment<3>(row_of(pull.pose)) += pull.rhs;
  }
  const Eigen::VectorXd d = H.bottomRightCorner(n - 3, n - 3).ldlt().solve(rhs.tail(n - 3));
  std::vector<Pose2> T_map_pose = problem.T_map_pose;
  for (std::size_t i = 1; i < T_map_pose.size(); ++i) {
    const Eigen::Vector3d moved = T_map_pose[i].vector() + d.segment<3>(row_of(i - 1));
    T_map_pose[i] = Pose2(moved[0], moved[1], moved[2]);
  }
  return T_map_pose;
}

void expect_same(const std::vector<Pose2>& a, const std::vector<Pose2>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(poses_near(a[i], b[i], tolerance, tolerance)) << i;
}

TEST(PoseSystem, EqualsADenseStep) {
  std::mt19937 random(91);
  for (std::uint32_t poses = 2; poses <= 30; ++poses) {
    const Problem problem = random_problem(random, poses);
    PoseSystem system;
    ASSERT_TRUE(system.prepare(poses, problem.factors));
    fill(system, problem);
    std::vector<Pose2> T_map_pose = problem.T_map_pose;
    const Result<double> largest = system.step(T_map_pose);
    ASSERT_TRUE(largest) << largest.error().message;
    expect_same(T_map_pose, dense_step(problem), 1e-8);
  }
}

TEST(PoseSystem, ABlockOfTwoPosesMayComeEitherWayRound) {
  const Eigen::Matrix3d H = 4.0 * Eigen::Matrix3d::Identity();
  Eigen::Matrix3d H_12 = Eigen::Matrix3d::Zero();
  H_12(0, 2) = 1.5;
  const auto moved = [&](bool later_first) {
    PoseSystem system;
    const std::vector<PosePair> pairs{
        {pose_index(1), pose_index(2)}, {pose_index(2), pose_index(1)}, {pose_index(0), pose_index(2)}};
    EXPECT_TRUE(system.prepare_pairs(3, pairs));
    system.set_zero();
    system.add(pose_index(1), H, Eigen::Vector3d(0.1, 0.2, 0.3));
    system.add(pose_index(2), H, Eigen::Vector3d(0.3, 0.1, 0.2));
    if (later_first)
      system.add(pose_index(2), pose_index(1), H_12.transpose());
    else
      system.add(pose_index(1), pose_index(2), H_12);
    system.add(pose_index(0), pose_index(2), H);  // the first pose is held
    std::vector<Pose2> T_map_pose(3);
    EXPECT_TRUE(system.step(T_map_pose));
    return T_map_pose;
  };
  Eigen::Matrix<double, 6, 6> dense = 4.0 * Eigen::Matrix<double, 6, 6>::Identity();
  dense(0, 5) = dense(5, 0) = 1.5;
  Eigen::Matrix<double, 6, 1> rhs;
  rhs << 0.1, 0.2, 0.3, 0.3, 0.1, 0.2;
  const Eigen::Matrix<double, 6, 1> expected = dense.inverse() * rhs;
  for (const bool later_first : {false, true}) {
    const std::vector<Pose2> T = moved(later_first);
    EXPECT_TRUE(poses_near(T[1], Pose2(expected(0), expected(1), expected(2)), 1e-12, 1e-12));
    EXPECT_TRUE(poses_near(T[2], Pose2(expected(3), expected(4), expected(5)), 1e-12, 1e-12));
  }
}

TEST(PoseSystem, ReportsTheLargestComponentOfTheStep) {
  for (const Eigen::Vector3d& pull :
       {Eigen::Vector3d(0.3, -0.1, 0.2), Eigen::Vector3d(0.1, -0.4, 0.2), Eigen::Vector3d(0.1, 0.2, -0.5)}) {
    PoseSystem system;
    ASSERT_TRUE(system.prepare(2, {}));
    system.set_zero();
    system.add(pose_index(1), Eigen::Matrix3d::Identity(), pull);
    std::vector<Pose2> T_map_pose(2);
    const Result<double> largest = system.step(T_map_pose);
    ASSERT_TRUE(largest);
    EXPECT_NEAR(*largest, pull.cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_TRUE(poses_near(T_map_pose[1], Pose2(pull[0], pull[1], pull[2]), 1e-12, 1e-12));
  }
}

TEST(PoseSystem, TheFirstPoseStaysWhateverPullsAtIt) {
  PoseSystem system;
  std::vector<Pose2> T_map_pose{Pose2(1.0, 2.0, 3.0), Pose2(4.0, 5.0, 0.5)};
  RelativePoseFactor<PoseIndex> c{pose_index(0), pose_index(1), between(T_map_pose[0], T_map_pose[1])};
  ASSERT_TRUE(system.prepare(2, std::vector<RelativePoseFactor<PoseIndex>>{c}));
  system.set_zero();
  system.add(c, 1.0, T_map_pose);
  system.add(pose_index(0), Eigen::Matrix3d::Identity(), Eigen::Vector3d(9.0, 9.0, 9.0));
  const std::vector<Pose2> before = T_map_pose;
  ASSERT_TRUE(system.step(T_map_pose));
  expect_same(T_map_pose, before, 1e-12);
}

TEST(PoseSystem, StepsLeadToWhatTheFactorsSay) {
  std::mt19937 random(92);
  std::vector<Pose2> truth;
  std::vector<RelativePoseFactor<PoseIndex>> factors;
  for (std::size_t i = 0; i < 12; ++i) truth.push_back(random_pose(random, 3.0));
  for (std::size_t i = 1; i < 12; ++i)
    factors.push_back({pose_index(i - 1), pose_index(i), between(truth[i - 1], truth[i])});
  factors.push_back({pose_index(11), pose_index(2), between(truth[11], truth[2])});
  std::vector<Pose2> T_map_pose = truth;
  for (std::size_t i = 1; i < 12; ++i) {
    T_map_pose[i] = Pose2(T_map_pose[i].x_m() + random_in(random, -0.2, 0.2),
                          T_map_pose[i].y_m() + random_in(random, -0.2, 0.2),
                          T_map_pose[i].yaw_rad() + random_in(random, -0.2, 0.2));
  }
  PoseSystem system;
  ASSERT_TRUE(system.prepare(T_map_pose.size(), factors));
  double largest = 1.0;
  for (int i = 0; i < 10 && largest > 1e-10; ++i) {
    system.set_zero();
    for (const RelativePoseFactor<PoseIndex>& c : factors) system.add(c, 1.0, T_map_pose);
    const Result<double> step = system.step(T_map_pose);
    ASSERT_TRUE(step);
    largest = *step;
  }
  EXPECT_LE(largest, 1e-10);
  expect_same(T_map_pose, truth, 1e-9);
}

TEST(PoseSystem, OneThatIsKeptSolvesLikeANewOne) {
  std::mt19937 random(93);
  PoseSystem kept;
  // Same pairs with other values; then another pair, more poses, fewer poses, and the first again.
  Problem first = random_problem(random, 15);
  std::vector<Problem> problems{first, first, first, random_problem(random, 25), random_problem(random, 4),
                                first};
  for (RelativePoseFactor<PoseIndex>& c : problems[1].factors)
    c.T_from_to = c.T_from_to * random_pose(random, 0.2);
  problems[2].factors.push_back({pose_index(14), pose_index(1), random_pose(random, 1.0)});
  problems[2].weights.push_back(1.0);
  for (const Problem& problem : problems) {
    ASSERT_TRUE(kept.prepare(problem.T_map_pose.size(), problem.factors));
    fill(kept, problem);
    PoseSystem fresh;
    ASSERT_TRUE(fresh.prepare(problem.T_map_pose.size(), problem.factors));
    fill(fresh, problem);
    std::vector<Pose2> T_kept = problem.T_map_pose;
    std::vector<Pose2> T_fresh = problem.T_map_pose;
    ASSERT_TRUE(kept.step(T_kept));
    ASSERT_TRUE(fresh.step(T_fresh));
    expect_same(T_kept, T_fresh, 0.0);
  }
}

TEST(PoseSystem, APoseThatNothingHoldsIsNamedAndNoneMoves) {
  std::mt19937 random(94);
  std::vector<Pose2> T_map_pose(4);
  for (Pose2& pose : T_map_pose) pose = random_pose(random, 2.0);
  const std::vector<RelativePoseFactor<PoseIndex>> factors{
      {pose_index(0), pose_index(1), Pose2(1.0, 0.0, 0.0)},
      {pose_index(1), pose_index(3), Pose2(1.0, 0.0, 0.0)}};
  PoseSystem system;
  ASSERT_TRUE(system.prepare(T_map_pose.size(), factors));
  system.set_zero();
  for (const RelativePoseFactor<PoseIndex>& c : factors) system.add(c, 1.0, T_map_pose);
  const std::vector<Pose2> before = T_map_pose;
  const Result<double> step = system.step(T_map_pose);
  ASSERT_FALSE(step);
  EXPECT_EQ(step.error().code, ErrorCode::kSolver);
  EXPECT_THAT(step.error().message, HasSubstr("near pose 2:"));
  expect_same(T_map_pose, before, 0.0);
}

TEST(PoseSystem, AStepThatIsNotFiniteIsAnErrorAndNoPoseMoves) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::vector<Pose2> T_map_pose{Pose2(), Pose2(1.0, 0.0, 0.0), Pose2(2.0, 0.0, 0.1)};
    const std::vector<RelativePoseFactor<PoseIndex>> factors{
        {pose_index(0), pose_index(1), Pose2(1.1, 0.0, 0.0)},
        {pose_index(1), pose_index(2), Pose2(1.0, 0.0, 0.0)}};
    PoseSystem system;
    ASSERT_TRUE(system.prepare(T_map_pose.size(), factors));
    system.set_zero();
    for (const RelativePoseFactor<PoseIndex>& c : factors) system.add(c, 1.0, T_map_pose);
    system.add(pose_index(2), Eigen::Matrix3d::Zero(), Eigen::Vector3d(0.0, bad, 0.0));
    const std::vector<Pose2> before = T_map_pose;
    const Result<double> step = system.step(T_map_pose);
    ASSERT_FALSE(step);
    EXPECT_EQ(step.error().code, ErrorCode::kSolver);
    expect_same(T_map_pose, before, 0.0);
  }
}

TEST(PoseSystem, SolvesAgainAfterAnError) {
  std::mt19937 random(95);
  const Problem problem = random_problem(random, 10);
  PoseSystem system;
  ASSERT_TRUE(system.prepare(10, problem.factors));
  std::vector<Pose2> T_map_pose = problem.T_map_pose;
  system.set_zero();
  ASSERT_FALSE(system.step(T_map_pose)) << "nothing holds any pose";
  fill(system, problem);
  ASSERT_TRUE(system.step(T_map_pose));
  expect_same(T_map_pose, dense_step(problem), 1e-8);
}

TEST(PoseSystemDeathTest, OnePoseAloneIsABrokenPromise) {
  PoseSystem system;
  EXPECT_DEATH((void)system.prepare(1, {}), "broken promise.*a pose to move");
}

}  // namespace
}  // namespace swiftlet

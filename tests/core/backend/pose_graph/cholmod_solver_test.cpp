// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/cholmod_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>
#include <utility>

#include "tests/support/random_draws.hpp"

namespace swiftlet {
namespace {

using testing::HasSubstr;
using BlockIndex = BlockSystem3::BlockIndex;

Eigen::MatrixXd dense(const BlockSystem3& system) {
  const auto n = static_cast<Eigen::Index>(system.unknowns());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index column = 0; column < n; ++column) {
    const auto c = static_cast<std::size_t>(column);
    for (int k = system.column_starts()[c]; k < system.column_starts()[c + 1]; ++k) {
      const Eigen::Index row = system.rows()[static_cast<std::size_t>(k)];
      A(row, column) = A(column, row) = system.values()[static_cast<std::size_t>(k)];
    }
  }
  return A;
}

Eigen::Map<const Eigen::VectorXd> view(const std::vector<double>& v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

std::vector<BlockIndex> random_pattern(std::mt19937& random, std::uint32_t blocks) {
  std::vector<BlockIndex> pattern;
  for (std::uint32_t b = 1; b < blocks; ++b) pattern.push_back({b, b - 1});
  for (std::uint32_t i = 0; i < blocks && blocks > 1; ++i) {
    const auto row = static_cast<std::uint32_t>(random_int(random, 1, static_cast<int>(blocks) - 1));
    pattern.push_back({row, static_cast<std::uint32_t>(random_int(random, 0, static_cast<int>(row) - 1))});
  }
  return pattern;
}

/// As constraints do: J^T J of each pair of blocks, which keeps the whole positive definite.
void fill(std::mt19937& random, const std::vector<BlockIndex>& pattern, BlockSystem3& system) {
  system.set_zero();
  for (std::uint32_t b = 0; b < system.unknowns() / 3; ++b) {
    const Eigen::Matrix3d prior = random_covariance(random, 0.5);
    system.add(b, b, prior.data());
  }
  for (const BlockIndex& at : pattern) {
    const auto draw = [&] { return random_in(random, -1.0, 1.0); };
    const Eigen::Matrix3d J_row = Eigen::Matrix3d::NullaryExpr(draw);
    const Eigen::Matrix3d J_column = Eigen::Matrix3d::NullaryExpr(draw);
    const Eigen::Matrix3d H_row = J_row.transpose() * J_row;
    const Eigen::Matrix3d H_column = J_column.transpose() * J_column;
    const Eigen::Matrix3d H_cross = J_row.transpose() * J_column;
    system.add(at.row, at.row, H_row.data());
    system.add(at.column, at.column, H_column.data());
    system.add(at.row, at.column, H_cross.data());
  }
  for (double& b : system.rhs) b = random_in(random, -10.0, 10.0);
}

void expect_solves(CholmodSolver& solver, const BlockSystem3& system) {
  const Result<std::vector<double>> x = solver.solve(system);
  ASSERT_TRUE(x) << x.error().message;
  const Eigen::VectorXd expected = dense(system).ldlt().solve(view(system.rhs));
  EXPECT_LT((view(*x) - expected).norm(), 1e-9 * (1.0 + expected.norm()));
}

TEST(BlockSystem3, AddsUpWhatIsAddedToABlock) {
  const std::vector<BlockIndex> pattern{{2, 0}, {1, 0}, {2, 0}};
  BlockSystem3 system(3, pattern);
  std::mt19937 random(51);
  const Eigen::Matrix3d A = Eigen::Matrix3d::NullaryExpr([&] { return random_in(random, -1.0, 1.0); });
  Eigen::Matrix3d symmetric;
  symmetric << 4.0, 1.0, 2.0, 1.0, 5.0, 3.0, 2.0, 3.0, 6.0;
  system.add(2, 0, A.data());
  system.add(2, 0, A.data());
  system.add(1, 1, symmetric.data());
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(9, 9);
  expected.block<3, 3>(6, 0) = 2.0 * A;
  expected.block<3, 3>(0, 6) = 2.0 * A.transpose();
  expected.block<3, 3>(3, 3) = symmetric;
  EXPECT_EQ(dense(system), expected);
}

TEST(BlockSystem3, HoldsTheLowerTriangleOfEachPairOnce) {
  const std::vector<BlockIndex> pattern{{1, 0}, {1, 0}};
  const BlockSystem3 system(2, pattern);
  EXPECT_EQ(system.unknowns(), 6U);
  EXPECT_EQ(system.values().size(), 6U + 9U + 6U);
  EXPECT_EQ(system.rhs.size(), 6U);
}

TEST(BlockSystem3, SetZeroForgetsValuesAndRightHandSide) {
  BlockSystem3 system(1, {});
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  system.add(0, 0, identity.data());
  system.rhs[1] = 4.0;
  system.set_zero();
  EXPECT_EQ(dense(system), Eigen::MatrixXd::Zero(3, 3));
  EXPECT_EQ(view(system.rhs).norm(), 0.0);
}

TEST(BlockSystem3DeathTest, BlocksOutsideThePatternAreABrokenPromise) {
  BlockSystem3 system(3, std::vector<BlockIndex>{{1, 0}});
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  EXPECT_DEATH(system.add(2, 0, identity.data()), "broken promise.*in the pattern");
}

TEST(CholmodSolver, EqualsADenseFactorisationOnRandomSystems) {
  std::mt19937 random(52);
  for (std::uint32_t blocks = 1; blocks <= 40; ++blocks) {
    const std::vector<BlockIndex> pattern = random_pattern(random, blocks);
    BlockSystem3 system(blocks, pattern);
    fill(random, pattern, system);
    CholmodSolver solver;
    ASSERT_TRUE(solver.analyze(system));
    expect_solves(solver, system);
  }
}

TEST(CholmodSolver, OneAnalysisServesEveryRefill) {
  std::mt19937 random(53);
  const std::vector<BlockIndex> pattern = random_pattern(random, 25);
  BlockSystem3 system(25, pattern);
  CholmodSolver solver;
  ASSERT_TRUE(solver.analyze(system)) << "the pattern is enough";
  for (int i = 0; i < 10; ++i) {
    fill(random, pattern, system);
    expect_solves(solver, system);
  }
}

TEST(CholmodSolver, ANewAnalysisServesANewPattern) {
  std::mt19937 random(54);
  CholmodSolver solver;
  for (const std::uint32_t blocks : {30U, 5U, 60U}) {
    const std::vector<BlockIndex> pattern = random_pattern(random, blocks);
    BlockSystem3 system(blocks, pattern);
    fill(random, pattern, system);
    ASSERT_TRUE(solver.analyze(system));
    expect_solves(solver, system);
  }
}

TEST(CholmodSolver, NamesTheBlockThatNothingHolds) {
  std::mt19937 random(55);
  for (std::uint32_t loose = 0; loose < 5; ++loose) {
    BlockSystem3 system(5, {});
    for (std::uint32_t b = 0; b < 5; ++b) {
      const Eigen::Matrix3d prior = random_covariance(random, 0.5);
      if (b != loose) system.add(b, b, prior.data());
    }
    CholmodSolver solver;
    ASSERT_TRUE(solver.analyze(system));
    const Result<std::vector<double>> x = solver.solve(system);
    ASSERT_FALSE(x);
    EXPECT_EQ(x.error().code, ErrorCode::kSolver);
    EXPECT_THAT(x.error().message, HasSubstr("underconstrained near pose " + std::to_string(loose) + ":"));
  }
}

TEST(CholmodSolver, RefusesAnIndefiniteSystem) {
  BlockSystem3 system(2, {});
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d saddle = Eigen::Vector3d(1.0, -1.0, 1.0).asDiagonal();
  system.add(0, 0, identity.data());
  system.add(1, 1, saddle.data());
  CholmodSolver solver;
  ASSERT_TRUE(solver.analyze(system));
  const Result<std::vector<double>> x = solver.solve(system);
  ASSERT_FALSE(x);
  EXPECT_EQ(x.error().code, ErrorCode::kSolver);
}

TEST(CholmodSolver, SolvesAgainAfterRefusing) {
  std::mt19937 random(56);
  const std::vector<BlockIndex> pattern = random_pattern(random, 12);
  BlockSystem3 system(12, pattern);
  CholmodSolver solver;
  ASSERT_TRUE(solver.analyze(system));
  ASSERT_FALSE(solver.solve(system)) << "all zeros";
  fill(random, pattern, system);
  expect_solves(solver, system);
}

TEST(CholmodSolverDeathTest, SolvingBeforeAnalysingIsABrokenPromise) {
  const BlockSystem3 system(1, {});
  CholmodSolver solver;
  EXPECT_DEATH((void)solver.solve(system), "broken promise.*analyze");
}

}  // namespace
}  // namespace swiftlet

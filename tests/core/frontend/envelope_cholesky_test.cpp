// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/envelope_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <vector>

#include "tests/support/random_geometry.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kStride = 40;

// A positive definite matrix with a random envelope, and the same as an EnvelopeMatrix. What lies outside the
// envelope is not a number, so that whoever reads it is found out.
struct RandomSystem {
  RandomSystem(std::size_t size, test::RandomGeometry& random)
      : dense(Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size))),
        values(kStride * kStride, std::numeric_limits<double>::quiet_NaN()),
        first_column(size) {
    for (std::size_t i = 0; i < size; ++i) {
      first_column[i] = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i) + 0.999));
      for (std::size_t j = first_column[i]; j <= i; ++j) {
        const double value = random.uniform(-1.0, 1.0) + (i == j ? static_cast<double>(size) : 0.0);
        values[i * kStride + j] = value;
        dense(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = value;
        dense(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = value;
      }
    }
  }
  EnvelopeMatrix view() { return {values.data(), kStride, first_column.size(), first_column.data()}; }

  Eigen::MatrixXd dense;
  std::vector<double> values;
  std::vector<std::size_t> first_column;
};

TEST(EnvelopeCholesky, SolvesWhatADenseFactorSolves) {
  test::RandomGeometry random(1);
  for (std::size_t size = 1; size <= kStride; ++size) {
    RandomSystem system(size, random);
    std::vector<double> b(size);
    for (double& x : b) x = random.uniform(-1.0, 1.0);
    const Eigen::VectorXd right = Eigen::Map<Eigen::VectorXd>(b.data(), static_cast<Eigen::Index>(size));
    ASSERT_TRUE(factor_in_place(system.view()));
    solve_in_place(system.view(), b);
    const Eigen::VectorXd expected = system.dense.llt().solve(right);
    EXPECT_TRUE(Eigen::Map<Eigen::VectorXd>(b.data(), expected.size()).isApprox(expected, 1e-10));
  }
}

TEST(EnvelopeCholesky, RefusesAMatrixThatIsNotPositiveDefinite) {
  test::RandomGeometry random(2);
  RandomSystem system(12, random);
  system.values[7 * kStride + 7] = -1.0;
  EXPECT_FALSE(factor_in_place(system.view()));
}

TEST(EnvelopeCholesky, RefusesAMatrixWithAHoleInIt) {
  test::RandomGeometry random(3);
  RandomSystem system(12, random);
  system.values[7 * kStride + 7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(factor_in_place(system.view()));
}

}  // namespace
}  // namespace swiftlet

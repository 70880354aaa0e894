// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <Eigen/Core>

namespace swiftlet::test {

/// Central differences of `f` (a vector of kRows) at `x` (a vector of kColumns).
template <int kRows, int kColumns, typename Function>
Eigen::Matrix<double, kRows, kColumns> numeric_jacobian(const Function& f,
                                                        const Eigen::Matrix<double, kColumns, 1>& x) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix<double, kRows, kColumns> J;
  for (int i = 0; i < kColumns; ++i) {
    Eigen::Matrix<double, kColumns, 1> above = x;
    Eigen::Matrix<double, kColumns, 1> below = x;
    above(i) += kStep;
    below(i) -= kStep;
    J.col(i) = (f(above) - f(below)) / (2.0 * kStep);
  }
  return J;
}

}  // namespace swiftlet::test

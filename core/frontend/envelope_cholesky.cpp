// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/envelope_cholesky.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"

namespace swiftlet {
namespace {

double dot(const double* a, const double* b, std::size_t n) {
  using ConstVector = Eigen::Map<const Eigen::VectorXd>;
  const auto size = static_cast<Eigen::Index>(n);
  return ConstVector(a, size).dot(ConstVector(b, size));
}

}  // namespace

bool factor_in_place(const EnvelopeMatrix& A) {
  for (std::size_t i = 0; i < A.size; ++i) {
    double* row_i = A.row(i);
    for (std::size_t j = A.first_column[i]; j < i; ++j) {
      const double* row_j = A.row(j);
      const std::size_t first = std::max(A.first_column[i], A.first_column[j]);
      if (first < j) row_i[j] -= dot(row_i + first, row_j + first, j - first);
      row_i[j] /= row_j[j];
    }
    const std::size_t first = A.first_column[i];
    const double pivot = row_i[i] - dot(row_i + first, row_i + first, i - first);
    if (!(pivot > 0.0) || !std::isfinite(pivot)) return false;
    row_i[i] = std::sqrt(pivot);
  }
  return true;
}

void solve_in_place(const EnvelopeMatrix& factor, std::span<double> b) {
  SWIFTLET_CHECK(b.size() == factor.size, "the right side has the size of the system");
  for (std::size_t i = 0; i < factor.size; ++i) {
    const std::size_t first = factor.first_column[i];
    b[i] = (b[i] - dot(factor.row(i) + first, b.data() + first, i - first)) / factor.row(i)[i];
  }
  for (std::size_t i = factor.size; i-- > 0;) {
    const double* row = factor.row(i);
    b[i] /= row[i];
    for (std::size_t j = factor.first_column[i]; j < i; ++j) b[j] -= row[j] * b[i];
  }
}

}  // namespace swiftlet

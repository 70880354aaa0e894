// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <span>

namespace swiftlet {

/// A symmetric matrix by its lower triangle, row by row; row i is empty left of column first_column[i]. Poses
/// in the order of time share landmarks with their neighbours only, so most of the triangle stays empty, and
/// Cholesky's factor fills no more than the same envelope (George & Liu, "Computer solution of large sparse
/// positive definite systems", 1981, chapter 4). Borrows its storage.
struct EnvelopeMatrix {
  double* values = nullptr;  ///< row i starts at values + i * stride
  std::size_t stride = 0;
  std::size_t size = 0;
  std::size_t* first_column = nullptr;  ///< per row, at most the row's own number

  [[nodiscard]] double* row(std::size_t i) const { return values + i * stride; }
};

/// Replaces A by L with A = L L^T. False when A is not positive definite; A is then undefined. Allocates
/// nothing.
[[nodiscard]] bool factor_in_place(const EnvelopeMatrix& A);

/// Replaces b by the solution of L L^T x = b. Precondition: factored.
void solve_in_place(const EnvelopeMatrix& factor, std::span<double> b);

}  // namespace swiftlet

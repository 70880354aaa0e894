// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/base/result.hpp"

namespace swiftlet {

/// A symmetric positive definite system over blocks of three unknowns, as the lower triangle of its block
/// pattern. The pattern is set once and filled many times.
class BlockSystem3 {
 public:
  struct BlockIndex {
    std::uint32_t row = 0;
    std::uint32_t column = 0;  ///< column <= row
  };

  /// Diagonal blocks are always there; `off_diagonal` may hold duplicates. Messages count blocks from
  /// `first_name`. Allocates.
  BlockSystem3(std::size_t block_count, std::span<const BlockIndex> off_diagonal,
               std::uint32_t first_name = 0);

  void set_zero();
  /// Adds to a block; off the diagonal row > column must be in the pattern. `block` is 3x3, column by column.
  void add(std::uint32_t row, std::uint32_t column, const double* block);

  [[nodiscard]] std::size_t unknowns() const { return 3 * block_count_; }
  [[nodiscard]] const std::vector<int>& column_starts() const { return column_starts_; }
  [[nodiscard]] const std::vector<int>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  [[nodiscard]] const std::vector<std::vector<std::uint32_t>>& block_rows() const { return block_rows_; }
  [[nodiscard]] std::uint32_t first_name() const { return first_name_; }
  std::vector<double> rhs;

 private:
  std::size_t block_count_;
  std::uint32_t first_name_;
  std::vector<std::vector<std::uint32_t>> block_rows_;  // of each block column, ascending, diagonal first
  std::vector<int> column_starts_;                      // compressed columns of the scalar lower triangle
  std::vector<int> rows_;
  std::vector<double> values_;
};

/// CHOLMOD's simplicial factorisation behind a wall: the only file that includes it. The fill-reducing
/// ordering is found on the 3x3 blocks and kept while the pattern stays the same. One thread at a time.
class CholmodSolver {
 public:
  CholmodSolver();
  ~CholmodSolver();
  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;

  /// Orders and analyses the pattern of `system`; must come before solve() and again when the pattern
  /// changes.
  Status analyze(const BlockSystem3& system);
  /// Solves for system.rhs. kSolver when not positive definite, naming the block.
  Result<std::vector<double>> solve(const BlockSystem3& system);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/pose_graph/cholmod_solver.hpp"

#include <cholmod.h>

#include <algorithm>
#include <string>

namespace swiftlet {

BlockSystem3::BlockSystem3(std::size_t block_count, std::span<const BlockIndex> off_diagonal,
                           std::uint32_t first_name)
    : rhs(3 * block_count, 0.0),
      block_count_(block_count),
      first_name_(first_name),
      block_rows_(block_count) {
  for (std::uint32_t b = 0; b < block_count; ++b) block_rows_[b].push_back(b);
  for (const BlockIndex& index : off_diagonal) {
    SWIFTLET_CHECK(index.row > index.column && index.row < block_count,
                   "off-diagonal blocks lie below the diagonal");
    block_rows_[index.column].push_back(index.row);
  }
  column_starts_.push_back(0);
  for (auto& column : block_rows_) {
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    for (int c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < column.size(); ++k) {
        // Only the lower triangle of the diagonal block.
        for (int r = k == 0 ? c : 0; r < 3; ++r) rows_.push_back(static_cast<int>(3 * column[k]) + r);
      }
      column_starts_.push_back(static_cast<int>(rows_.size()));
    }
  }
  values_.resize(rows_.size(), 0.0);
}

void BlockSystem3::set_zero() {
  std::fill(values_.begin(), values_.end(), 0.0);
  std::fill(rhs.begin(), rhs.end(), 0.0);
}

void BlockSystem3::add(std::uint32_t row, std::uint32_t column, const double* block) {
  const auto& rows = block_rows_[column];
  const auto found = row == column ? rows.begin() : std::lower_bound(rows.begin(), rows.end(), row);
  SWIFTLET_CHECK(found != rows.end() && *found == row, "the block is in the pattern");
  const auto k = static_cast<std::size_t>(found - rows.begin());
  for (std::size_t c = 0; c < 3; ++c) {
    const auto start = static_cast<std::size_t>(column_starts_[std::size_t{3} * column + c]);
    // Column c of the diagonal block holds its last 3 - c rows.
    const std::size_t first_row = k == 0 ? c : 0;
    const std::size_t at = start + (k == 0 ? 0 : (3 - c) + 3 * (k - 1));
    for (std::size_t r = first_row; r < 3; ++r) values_[at + r - first_row] += block[3 * c + r];
  }
}

struct CholmodSolver::State {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;

  State() {
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SIMPLICIAL;  // faster on these graphs with reference BLAS, and LGPL
    common.final_ll = 1;
    common.print = 0;
    common.nmethods = 1;
  }
  ~State() {
    if (factor != nullptr) cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

namespace {

/// CHOLMOD's view of arrays it must not change: its interface is not const-correct, its functions are.
template <typename T>
T* unconst(const T* data) {
  return const_cast<T*>(data);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

cholmod_sparse view_of(const BlockSystem3& system) {
  cholmod_sparse view{};
  view.nrow = view.ncol = system.unknowns();
  view.nzmax = system.values().size();
  view.p = unconst(system.column_starts().data());
  view.i = unconst(system.rows().data());
  view.x = unconst(system.values().data());
  view.stype = -1;  // lower triangle
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

/// AMD on the graph of blocks, a ninth of the work of ordering scalars, widened to the three unknowns of
/// each.
std::vector<int> block_ordering(const BlockSystem3& system, cholmod_common* common) {
  const auto& columns = system.block_rows();
  std::vector<int> starts{0};
  std::vector<int> rows;
  for (const auto& column : columns) {
    for (const std::uint32_t row : column) rows.push_back(static_cast<int>(row));
    starts.push_back(static_cast<int>(rows.size()));
  }
  cholmod_sparse pattern{};
  pattern.nrow = pattern.ncol = columns.size();
  pattern.nzmax = rows.size();
  pattern.p = starts.data();
  pattern.i = rows.data();
  pattern.stype = -1;
  pattern.itype = CHOLMOD_INT;
  pattern.xtype = CHOLMOD_PATTERN;
  pattern.dtype = CHOLMOD_DOUBLE;
  pattern.sorted = 1;
  pattern.packed = 1;
  std::vector<int> blocks(columns.size());
  std::vector<int> scalars;
  if (cholmod_amd(&pattern, nullptr, 0, blocks.data(), common) == 0) return scalars;
  scalars.reserve(3 * blocks.size());
  for (const int b : blocks) {
    for (int c = 0; c < 3; ++c) scalars.push_back(3 * b + c);
  }
  return scalars;
}

}  // namespace

CholmodSolver::CholmodSolver() : state_(std::make_unique<State>()) {}
CholmodSolver::~CholmodSolver() = default;

Status CholmodSolver::analyze(const BlockSystem3& system) {
  if (state_->factor != nullptr) cholmod_free_factor(&state_->factor, &state_->common);
  std::vector<int> ordering = block_ordering(system, &state_->common);
  if (ordering.empty())
    return Error{ErrorCode::kSolver, "pose graph: no elimination order found (out of memory?)"};
  cholmod_sparse A = view_of(system);
  state_->common.method[0].ordering = CHOLMOD_GIVEN;
  state_->factor = cholmod_analyze_p(&A, ordering.data(), nullptr, 0, &state_->common);
  if (state_->factor == nullptr)
    return Error{ErrorCode::kSolver, "pose graph: symbolic analysis failed (out of memory?)"};
  return {};
}

Result<std::vector<double>> CholmodSolver::solve(const BlockSystem3& system) {
  SWIFTLET_CHECK(state_->factor != nullptr, "analyze() comes before solve()");
  cholmod_sparse A = view_of(system);
  cholmod_factorize(&A, state_->factor, &state_->common);
  if (state_->common.status == CHOLMOD_NOT_POSDEF) {
    const int* order = static_cast<const int*>(state_->factor->Perm);
    const std::size_t block =
        static_cast<std::size_t>(order[state_->factor->minor]) / 3 + system.first_name();
    return Error{ErrorCode::kSolver, "pose graph underconstrained near pose " + std::to_string(block) +
                                         ": its constraints leave a direction open"};
  }
  if (state_->common.status < 0)
    return Error{ErrorCode::kSolver, "pose graph: factorisation failed (out of memory?)"};
  cholmod_dense b{};
  b.nrow = b.nzmax = b.d = system.unknowns();
  b.ncol = 1;
  b.x = unconst(system.rhs.data());
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, state_->factor, &b, &state_->common);
  if (x == nullptr) return Error{ErrorCode::kSolver, "pose graph: solve failed (out of memory?)"};
  const double* first = static_cast<const double*>(x->x);
  std::vector<double> solution(first, first + system.unknowns());
  cholmod_free_dense(&x, &state_->common);
  return solution;
}

}  // namespace swiftlet

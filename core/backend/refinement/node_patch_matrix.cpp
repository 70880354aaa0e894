// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/node_patch_matrix.hpp"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <tuple>
#include <utility>

namespace swiftlet {
namespace {

using NodePair = NodePatchMatrix::NodePair;

bool is_before(const NodePair& a, const NodePair& b) {
  return std::tie(a.earlier, a.later) < std::tie(b.earlier, b.later);
}

std::vector<NodePair> each_once(std::vector<NodePair> pairs) {
  std::sort(pairs.begin(), pairs.end(), is_before);
  const auto end = std::unique(pairs.begin(), pairs.end(),
                               [](const NodePair& a, const NodePair& b) { return !is_before(a, b); });
  pairs.erase(end, pairs.end());
  return pairs;
}

}  // namespace

NodePatchMatrix::NodePatchMatrix(std::size_t nodes, std::size_t patches, std::vector<NodePair> pairs,
                                 std::span<const Sight> sights)
    : nodes_(nodes), pairs_(each_once(std::move(pairs))) {
  order(patches, sights);
  std::vector<int> heights(nodes + patches, 0);  // of what is above the diagonal
  pair_at_.reserve(pairs_.size());
  sight_at_.reserve(sights.size());
  for (const NodePair& p : pairs_) pair_at_.push_back(place(p.later, p.earlier, heights));
  for (const Sight& s : sights) sight_at_.push_back(place(nodes_ + s.patch, s.node, heights));
  lay_out(heights, sights);
}

/// Which block follows which.
void NodePatchMatrix::order(std::size_t patches, std::span<const Sight> sights) {
  using Pattern = Eigen::SparseMatrix<double>;
  const std::size_t blocks = nodes_ + patches;
  std::vector<Eigen::Triplet<double>> joined;
  joined.reserve(blocks + pairs_.size() + sights.size());
  for (int b = 0; b < static_cast<int>(blocks); ++b) joined.emplace_back(b, b, 1.0);
  for (const NodePair& p : pairs_)
    joined.emplace_back(static_cast<int>(p.later), static_cast<int>(p.earlier), 1.0);
  for (const Sight& s : sights)
    joined.emplace_back(static_cast<int>(nodes_ + s.patch), static_cast<int>(s.node), 1.0);
  Pattern pattern(static_cast<Eigen::Index>(blocks), static_cast<Eigen::Index>(blocks));
  pattern.setFromTriplets(joined.begin(), joined.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> block_at;
  Eigen::AMDOrdering<int>()(pattern.selfadjointView<Eigen::Lower>(), block_at);
  row_of_.resize(blocks);
  int row = 0;
  for (Eigen::Index k = 0; k < block_at.size(); ++k) {
    const auto block = static_cast<std::size_t>(block_at.indices()(k));
    row_of_[block] = row;
    row += width_of(block);
  }
}

/// On top of what the columns of the later of the two hold already.
NodePatchMatrix::Place NodePatchMatrix::place(std::size_t row_block, std::size_t column_block,
                                              std::vector<int>& heights) const {
  const bool is_flipped = row_of_[row_block] > row_of_[column_block];
  const std::size_t above = is_flipped ? column_block : row_block;
  const std::size_t below = is_flipped ? row_block : column_block;
  const Place place{row_of_[below], heights[below], is_flipped};
  heights[below] += width_of(above);
  return place;
}

void NodePatchMatrix::lay_out(std::span<const int> heights, std::span<const Sight> sights) {
  Eigen::Index entries = 0;
  Eigen::Index rows = 0;
  for (std::size_t b = 0; b < heights.size(); ++b) {
    const int width = width_of(b);
    entries += width * heights[b] + width * (width + 1) / 2;
    rows += width;
  }
  upper_.resize(rows, rows);
  upper_.resizeNonZeros(entries);
  int* const starts = upper_.outerIndexPtr();
  for (std::size_t b = 0; b < heights.size(); ++b)
    for (int c = 0; c < width_of(b); ++c) starts[row_of_[b] + c + 1] = heights[b] + c + 1;
  for (Eigen::Index k = 0; k < rows; ++k) starts[k + 1] += starts[k];
  int* const row = upper_.innerIndexPtr();
  const auto put = [&](const Place& at, std::size_t row_block, std::size_t column_block) {
    const std::size_t above = at.is_flipped ? column_block : row_block;
    const std::size_t below = at.is_flipped ? row_block : column_block;
    for (int c = 0; c < width_of(below); ++c)
      for (int r = 0; r < width_of(above); ++r)
        row[starts[at.column + c] + at.above + r] = row_of_[above] + r;
  };
  for (std::size_t k = 0; k < pairs_.size(); ++k) put(pair_at_[k], pairs_[k].later, pairs_[k].earlier);
  for (std::size_t k = 0; k < sights.size(); ++k) put(sight_at_[k], nodes_ + sights[k].patch, sights[k].node);
  for (std::size_t b = 0; b < heights.size(); ++b)
    for (int c = 0; c < width_of(b); ++c)
      for (int r = 0; r <= c; ++r) row[starts[row_of_[b] + c] + heights[b] + r] = row_of_[b] + r;
  set_zero();
}

void NodePatchMatrix::add_pair(NodePair pair, const Eigen::Matrix3d& later_by_earlier) {
  const auto at = std::lower_bound(pairs_.begin(), pairs_.end(), pair, is_before);
  add<3>(pair_at_[static_cast<std::size_t>(at - pairs_.begin())], later_by_earlier);
}

}  // namespace swiftlet

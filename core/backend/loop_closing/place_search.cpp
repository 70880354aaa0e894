// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/place_search.hpp"

#include <algorithm>
#include <utility>

#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

constexpr int kCoarseness = 3;         // cells a side of a coarse cell: as wide as the max kernel
constexpr double kHeadingReach = 2.0;  // coarse angular steps around what the coarse search has found

/// Those that the one before and the one behind draw again, half by half.
void leave_out_covered(std::vector<std::shared_ptr<const Submap>>& submaps) {
  const auto meet = [](const Submap& earlier, const Submap& later) {
    return later.scans.first < earlier.scans.end;
  };
  std::vector<std::shared_ptr<const Submap>> kept;
  for (std::size_t i = 0; i < submaps.size(); ++i) {
    const bool is_covered = i > 0 && i + 1 < submaps.size() && kept.back() == submaps[i - 1] &&
                            meet(*submaps[i - 1], *submaps[i]) && meet(*submaps[i], *submaps[i + 1]);
    if (!is_covered) kept.push_back(submaps[i]);
  }
  submaps = std::move(kept);
}

/// Anywhere on the submap, with any heading.
SearchWindow window_over(const Submap& submap) {
  const Point2& low = submap.low_m;
  const Point2& high = submap.high_m;
  return {Pose2(0.5 * (low.x_m + high.x_m), 0.5 * (low.y_m + high.y_m), 0.0),
          0.5 * std::max(high.x_m - low.x_m, high.y_m - low.y_m), kPi};
}

/// With the largest of the cells that make a cell, so that no score is less than the submap's.
Submap coarse(const Submap& submap) {
  Submap result = submap;
  GridGeometry& grid = result.geometry;
  grid.resolution_m *= kCoarseness;
  grid.width = (grid.width + kCoarseness - 1) / kCoarseness;
  grid.height = (grid.height + kCoarseness - 1) / kCoarseness;
  result.cells.assign(grid.cell_count(), 0);
  auto value = submap.cells.begin();
  for (int y = 0; y < submap.geometry.height; ++y) {
    for (int x = 0; x < submap.geometry.width; ++x) {
      std::uint8_t& largest = result.cells[grid.offset({x / kCoarseness, y / kCoarseness})];
      largest = std::max(largest, *value++);
    }
  }
  return result;
}

}  // namespace

void PlaceSearch::stop() {
  left_.clear();
  found_.clear();
  cross_check_.reset();
}

void PlaceSearch::begin(KeyframeId query, const ScanRange& recent,
                        std::span<const std::shared_ptr<const Submap>> submaps,
                        const KeyframePoses& T_local_keyframe) {
  stop();
  query_ = query;
  const Pose2 T_query_local = T_local_keyframe[query].inverse();
  const double thinning_cell_m = config_->tuning.detector.thinning_cell_m;
  points_query_ = thinned_hits(*scans_, *chain_, recent, T_local_keyframe, T_query_local, thinning_cell_m);
  coarse_points_query_ =
      thinned_hits(*scans_, *chain_, recent, T_local_keyframe, T_query_local, kCoarseness * thinning_cell_m);
  if (points_query_.size() < static_cast<std::size_t>(config_->min_match_points)) return;
  cross_check_.emplace(*config_, *scans_, *chain_, recent, query, T_local_keyframe);
  for (const auto& submap : submaps)
    if (submap->storey == chain_->storey(query)) left_.push_back(submap);
  leave_out_covered(left_);
}

/// The best of all places in coarse cells, and then the best around it.
std::optional<MatchResult> PlaceSearch::match_anywhere(const Submap& submap) const {
  const CorrelativeMatcherTuning& tuning = config_->tuning.matcher;
  const Submap coarse_submap = coarse(submap);
  const CorrelativeMatcher anywhere(coarse_submap, coarse_points_query_, window_over(submap), tuning);
  const std::optional<DiscreteMatch> found = anywhere.best_by_branch_and_bound(config_->min_score);
  if (!found) return std::nullopt;
  const SearchWindow around{anywhere.T_submap_scan(*found), tuning.max_spread_m,
                            kHeadingReach * anywhere.angle_step_rad()};
  return CorrelativeMatcher(submap, points_query_, around, tuning).match(config_->min_score);
}

void PlaceSearch::step() {
  const std::shared_ptr<const Submap> submap = left_.back();
  left_.pop_back();
  const std::optional<MatchResult> match = match_anywhere(*submap);
  if (!match || !cross_check_->holds(*submap, match->T_submap_scan_best)) return;
  found_.push_back({.from = submap->reference,
                    .to = query_,
                    .T_from_to = match->T_submap_scan,
                    .covariance = Covariance3::from_matrix(match->covariance),
                    .score = match->score});
}

}  // namespace swiftlet

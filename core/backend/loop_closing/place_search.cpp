// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/place_search.hpp"

#include <algorithm>

#include "core/backend/loop_closing/correlative_matcher.hpp"
#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

/// Anywhere on the submap, with any heading.
SearchWindow window_over(const Submap& submap) {
  const Point2& low = submap.low_m;
  const Point2& high = submap.high_m;
  return {Pose2(0.5 * (low.x_m + high.x_m), 0.5 * (low.y_m + high.y_m), 0.0),
          0.5 * std::max(high.x_m - low.x_m, high.y_m - low.y_m), kPi};
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
  points_query_ = thinned_hits(*scans_, *chain_, recent, T_local_keyframe, T_local_keyframe[query].inverse(),
                               config_->tuning.detector.thinning_cell_m);
  if (points_query_.size() < static_cast<std::size_t>(config_->min_match_points)) return;
  cross_check_.emplace(*config_, *scans_, *chain_, recent, query, T_local_keyframe);
  for (std::size_t i = 0; i < submaps.size(); i += 2) left_.push_back(submaps[i]);
}

void PlaceSearch::step() {
  const std::shared_ptr<const Submap> submap = left_.back();
  left_.pop_back();
  const std::optional<MatchResult> match =
      CorrelativeMatcher(*submap, points_query_, window_over(*submap), config_->tuning.matcher)
          .match(config_->min_score);
  if (!match || !cross_check_->holds(*submap, match->T_submap_scan_best)) return;
  found_.push_back({.from = submap->reference,
                    .to = query_,
                    .T_from_to = match->T_submap_scan,
                    .covariance = Covariance3::from_matrix(match->covariance),
                    .score = match->score});
}

}  // namespace swiftlet

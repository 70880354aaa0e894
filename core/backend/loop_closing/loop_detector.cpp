// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/loop_detector.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/backend/loop_closing/correlative_matcher.hpp"
#include "core/backend/loop_closing/cross_check.hpp"
#include "core/backend/pose_graph/relative_uncertainty.hpp"

namespace swiftlet {
namespace {

double newer_length_m(const BackendConfig& config) {
  return std::min(config.tuning.detector.newer_query_m, config.multiscan_length_m);
}

double widest_search_m(const BackendConfig& config) {
  return std::max(config.tuning.detector.min_search_radius_m, config.search_radius_m);
}

/// Around a box.
struct Disc {
  Disc(const Point2& low, const Point2& high)
      : centre{0.5 * (low.x_m + high.x_m), 0.5 * (low.y_m + high.y_m)},
        radius_m(0.5 * distance_m(low, high)) {}
  Point2 centre;
  double radius_m;
};

Disc disc_around(std::span<const Point2> points) {
  Point2 low = points.front();
  Point2 high = low;
  for (const Point2& p : points) {
    low = {std::min(low.x_m, p.x_m), std::min(low.y_m, p.y_m)};
    high = {std::max(high.x_m, p.x_m), std::max(high.y_m, p.y_m)};
  }
  return {low, high};
}

/// Around the submap's box, grown by `reach_m` on all sides.
Disc disc_around(const Submap& submap, double reach_m) {
  return {{submap.low_m.x_m - reach_m, submap.low_m.y_m - reach_m},
          {submap.high_m.x_m + reach_m, submap.high_m.y_m + reach_m}};
}

/// False only where the discs have no point in common, whatever the rounding.
bool may_overlap(const Disc& a, const Pose2& T_map_a, const Disc& b, const Pose2& T_map_b) {
  constexpr double kRoundingM = 1e-3;
  return distance_m(T_map_a * a.centre, T_map_b * b.centre) < a.radius_m + b.radius_m + kRoundingM;
}

/// Of the points, those that may fall on the submap somewhere in the window.
double share_within(std::span<const Point2> points, const SearchWindow& window, const Submap& submap) {
  const double r = window.radius_m;
  std::size_t inside = 0;
  for (const Point2& p : points) {
    const Point2 q = window.T_submap_scan * p;
    inside += q.x_m > submap.low_m.x_m - r && q.x_m < submap.high_m.x_m + r && q.y_m > submap.low_m.y_m - r &&
              q.y_m < submap.high_m.y_m + r;
  }
  return static_cast<double>(inside) / static_cast<double>(points.size());
}

/// Each place and heading of a wide window may be the best by chance: odds of as many to one, at
/// likelihood_per_score, are asked for beyond those in the narrowest window.
double score_needed(const SearchWindow& window, const BackendConfig& config) {
  const LoopDetectorTuning& narrowest = config.tuning.detector;
  const double width = window.radius_m / narrowest.min_search_radius_m;
  const double volume = width * width * window.angle_rad / narrowest.min_search_angle_rad;
  return config.min_score + std::log(volume) / config.tuning.matcher.likelihood_per_score;
}

}  // namespace

/// The last metres before a keyframe.
struct LoopDetector::Travel {
  std::vector<Point2> points;  ///< its hits, in the frame of that keyframe
  CrossCheck cross_check;
};

struct LoopDetector::Candidate {
  Travel* travel = nullptr;  ///< that is matched
  const Submap* submap = nullptr;
  SearchWindow window;
  double overlap = 0.0;  ///< share of the points that may fall on the submap
};

ScanRange LoopDetector::recent_scans(KeyframeId query) const {
  return newest_scans(query, config_->multiscan_length_m);
}

ScanRange LoopDetector::newest_scans(KeyframeId query, double length_m) const {
  const ScanId newest = chain_->scan_of(query);
  const double from_m = chain_->path_m(query) - length_m;
  const std::span<const StoredScan> scans = scans_->all().values();
  std::size_t first = scans_->all().position(newest);
  // What lies before the start of a segment is not connected by motion.
  while (first > 0 && !scans[first].starts_segment && scans[first - 1].storey == scans[first].storey &&
         scans[first - 1].path_m >= from_m)
    --first;
  return {scans_->all().id_at(first), newest + 1};
}

/// Nothing where it decides nothing.
std::optional<LoopDetector::Travel> LoopDetector::newest_travel(KeyframeId query, double length_m,
                                                                const KeyframePoses& T_local_keyframe) const {
  const ScanRange scans = newest_scans(query, length_m);
  // Less than the travel from the keyframe before cannot be drawn, and so not be held the other way round.
  if (query == chain_->all().first_id() || chain_->scan_of(chain_->all().previous(query)) < scans.first)
    return std::nullopt;
  std::vector<Point2> points =
      thinned_hits(*scans_, *chain_, scans, T_local_keyframe, T_local_keyframe[query].inverse(),
                   config_->tuning.detector.thinning_cell_m);
  if (points.size() < static_cast<std::size_t>(config_->min_match_points)) return std::nullopt;
  return Travel{std::move(points), CrossCheck(*config_, *scans_, *chain_, scans, query, T_local_keyframe)};
}

std::vector<LoopDetector::Candidate> LoopDetector::candidates(
    KeyframeId query, KeyframeId since, Travel& whole, Travel& newer,
    std::span<const std::shared_ptr<const Submap>> submaps, const PoseGraph& graph) const {
  std::vector<Candidate> found;
  std::optional<IdMap<KeyframeId, Eigen::Matrix3d>> covariances;
  const Pose2& T_map_query = graph.T_map_keyframe[query];
  const Pose2 T_query_map = T_map_query.inverse();
  const Disc around_points = disc_around(whole.points);
  const LoopDetectorTuning& tuning = config_->tuning.detector;
  for (const auto& submap : submaps) {
    if (submap->storey != chain_->storey(query)) continue;
    if (submap->reference >= since &&
        chain_->path_m(query) - submap->end_path_m < config_->min_travel_between_m)
      continue;
    const Disc around_search = disc_around(*submap, widest_search_m(*config_));
    if (!may_overlap(around_points, T_map_query, around_search, graph.T_map_keyframe[submap->reference]))
      continue;
    if (!covariances) covariances = relative_covariances(graph, query, config_->tuning.covariance);
    const Pose2 T_query_submap = T_query_map * graph.T_map_keyframe[submap->reference];
    // From the covariance of T_query_submap to that of its inverse, which is searched.
    const Eigen::Matrix3d J = jacobian_inverse(T_query_submap);
    const Eigen::Matrix3d P = J * (*covariances)[submap->reference] * J.transpose();
    Candidate c;
    c.submap = submap.get();
    c.window.T_submap_scan = T_query_submap.inverse();
    const double sigma_m = std::sqrt(std::max(P(0, 0), P(1, 1)));
    c.window.radius_m = std::min(std::max(tuning.search_sigmas * sigma_m, tuning.min_search_radius_m),
                                 widest_search_m(*config_));
    c.window.angle_rad =
        std::min(std::max(tuning.search_sigmas * std::sqrt(P(2, 2)), tuning.min_search_angle_rad),
                 config_->search_angle_rad);
    c.travel = c.window.radius_m <= tuning.newer_query_m ? &newer : &whole;
    c.overlap = share_within(c.travel->points, c.window, *submap);
    if (c.overlap >= config_->min_score) found.push_back(c);
  }
  const auto most = static_cast<std::size_t>(config_->max_candidates);
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.overlap > b.overlap; });
  if (found.size() > most) found.resize(most);
  return found;
}

FoundLoops LoopDetector::find(KeyframeId query, KeyframeId since,
                              std::span<const std::shared_ptr<const Submap>> submaps, const PoseGraph& graph,
                              const KeyframePoses& T_local_keyframe, std::uint64_t& tried) const {
  FoundLoops loops;
  std::optional<Travel> whole = newest_travel(query, config_->multiscan_length_m, T_local_keyframe);
  if (!whole) return loops;
  std::optional<Travel> newer = newest_travel(query, newer_length_m(*config_), T_local_keyframe);
  for (const Candidate& c : candidates(query, since, *whole, newer ? *newer : *whole, submaps, graph)) {
    ++tried;
    const std::optional<MatchResult> match =
        CorrelativeMatcher(*c.submap, c.travel->points, c.window, config_->tuning.matcher)
            .match(config_->min_score);
    if (!match || !c.travel->cross_check.holds(*c.submap, match->T_submap_scan_best)) continue;
    const bool is_sure = match->score >= score_needed(c.window, *config_) && c.submap->reference >= since;
    (is_sure ? loops.confirmed : loops.tentative)
        .push_back({.from = c.submap->reference,
                    .to = query,
                    .T_from_to = match->T_submap_scan,
                    .covariance = Covariance3::from_matrix(match->covariance),
                    .score = match->score});
    if (loops.confirmed.size() == config_->tuning.detector.max_closures) break;
  }
  return loops;
}

}  // namespace swiftlet

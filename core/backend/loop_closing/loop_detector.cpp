// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/loop_detector.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/backend/loop_closing/correlative_matcher.hpp"
#include "core/backend/loop_closing/cross_check.hpp"
#include "core/backend/pose_graph/relative_uncertainty.hpp"

namespace swiftlet {
namespace {

constexpr double kSigmas = 3.0;      // the window reaches this many standard deviations ...
constexpr double kMinRadiusM = 0.5;  // ... and never less than this: the constraints' covariances are models
// Of one query. More of the same travel tell little that is new, and where every lap overlaps all those
// before it they fill the pose graph's factor.
constexpr std::size_t kMaxClosures = 3;

double lowest_score(const BackendConfig& config) {
  return std::min(config.min_group_score, config.min_score);
}

}  // namespace

struct LoopDetector::Candidate {
  const Submap* submap = nullptr;
  SearchWindow window;
  double overlap = 0.0;  ///< share of the points that may fall on the submap
};

ScanRange LoopDetector::recent_scans(KeyframeId query) const {
  const ScanId newest = chain_->scan_of(query);
  const double from_m = chain_->path_m(query) - config_->multiscan_length_m;
  const std::span<const StoredScan> scans = scans_->all().values();
  std::size_t first = scans_->all().position(newest);
  // What lies before the start of a segment is not connected by motion.
  while (first > 0 && !scans[first].starts_segment && scans[first - 1].path_m >= from_m) --first;
  return {scans_->all().id_at(first), newest + 1};
}

std::vector<LoopDetector::Candidate> LoopDetector::candidates(
    KeyframeId query, std::span<const Point2> points_query,
    std::span<const std::shared_ptr<const Submap>> submaps, const PoseGraph& graph) const {
  std::vector<Candidate> found;
  std::optional<IdMap<KeyframeId, Eigen::Matrix3d>> covariances;
  const Pose2 T_query_map = graph.T_map_keyframe[query].inverse();
  for (const auto& submap : submaps) {
    if (chain_->path_m(query) - submap->end_path_m < config_->min_travel_between_m) continue;
    if (!covariances) covariances = relative_covariances(graph, query);
    const Pose2 T_query_submap = T_query_map * graph.T_map_keyframe[submap->reference];
    // From the covariance of T_query_submap to that of its inverse, which is searched.
    const Eigen::Matrix3d J = jacobian_inverse(T_query_submap);
    const Eigen::Matrix3d P = J * (*covariances)[submap->reference] * J.transpose();
    Candidate c;
    c.submap = submap.get();
    c.window.T_submap_scan = T_query_submap.inverse();
    const double sigma_m = std::sqrt(std::max(P(0, 0), P(1, 1)));
    c.window.radius_m =
        std::clamp(kSigmas * sigma_m, kMinRadiusM, std::max(kMinRadiusM, config_->search_radius_m));
    c.window.angle_rad =
        std::clamp(kSigmas * std::sqrt(P(2, 2)), kMinSearchAngleRad, config_->search_angle_rad);
    std::size_t inside = 0;
    for (const Point2& p : points_query) {
      const Point2 q = c.window.T_submap_scan * p;
      const double r = c.window.radius_m;
      inside += q.x_m > submap->low_m.x_m - r && q.x_m < submap->high_m.x_m + r &&
                q.y_m > submap->low_m.y_m - r && q.y_m < submap->high_m.y_m + r;
    }
    c.overlap = static_cast<double>(inside) / static_cast<double>(points_query.size());
    if (c.overlap >= lowest_score(*config_)) found.push_back(c);
  }
  const auto most = static_cast<std::size_t>(config_->max_candidates);
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.overlap > b.overlap; });
  if (found.size() > most) found.resize(most);
  return found;
}

FoundLoops LoopDetector::find(KeyframeId query, std::span<const std::shared_ptr<const Submap>> submaps,
                              const PoseGraph& graph, const KeyframePoses& T_local_keyframe,
                              std::uint64_t& tried) const {
  FoundLoops loops;
  const ScanRange recent = recent_scans(query);
  // Less than the travel from the keyframe before cannot be drawn, and so not be held the other way round.
  if (query == chain_->all().first_id() || chain_->scan_of(chain_->all().previous(query)) < recent.first)
    return loops;
  const std::vector<Point2> points =
      thinned_hits(*scans_, *chain_, recent, T_local_keyframe, T_local_keyframe[query].inverse());
  if (points.size() < static_cast<std::size_t>(config_->min_match_points)) return loops;
  CrossCheck reverse(*config_, *scans_, *chain_, recent, query, T_local_keyframe);
  for (const Candidate& c : candidates(query, points, submaps, graph)) {
    ++tried;
    const std::optional<MatchResult> match =
        CorrelativeMatcher(*c.submap, points, c.window).match(lowest_score(*config_));
    if (!match || !reverse.holds(*c.submap, match->T_submap_scan_best)) continue;
    (match->score < config_->min_score ? loops.maybe : loops.sure)
        .push_back({.from = c.submap->reference,
                    .to = query,
                    .T_from_to = match->T_submap_scan,
                    .covariance = Covariance3::from_matrix(match->covariance),
                    .score = match->score});
    if (loops.sure.size() == kMaxClosures) break;
  }
  return loops;
}

}  // namespace swiftlet

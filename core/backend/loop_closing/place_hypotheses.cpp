// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/place_hypotheses.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/backend/loop_closing/correlative_matcher.hpp"
#include "core/backend/loop_closing/cross_check.hpp"
#include "core/backend/pose_graph/relative_uncertainty.hpp"
#include "core/geometry/angle.hpp"

namespace swiftlet {
namespace {

constexpr double kEvenPer255 = 127.5;
/// Mean of seen() over the points of a query at the right place: carried vehicles gained 5 to 6 nats of 20.
constexpr double kUsualExcess = 0.25;
constexpr double kMaxTurnRad = kPi / 2.0;  // of a vehicle whose estimate ran on, beyond it
constexpr double kImpossible = -std::numeric_limits<double>::infinity();

/// Where tracking searches from one, the other may be found: as far as the corner of its window.
bool are_alike(const Pose2& a, const Pose2& b, const LoopDetectorTuning& window) {
  const Pose2 off = between(a, b);
  return std::hypot(off.x_m(), off.y_m()) < std::numbers::sqrt2 * window.min_search_radius_m &&
         std::abs(off.yaw_rad()) < 2.0 * window.min_search_angle_rad;
}

/// Points on ground that the submap knows, and the sum of their probabilities less one half.
struct Seen {
  std::size_t known = 0;
  double excess = 0.0;
};
Seen seen(const Submap& submap, std::span<const Point2> points, const Pose2& T_submap_points) {
  Seen sum;
  for (const Point2& p : points) {
    const CellIndex cell = submap.geometry.cell(T_submap_points * p);
    if (!submap.geometry.contains(cell)) continue;
    const std::uint8_t occupied = submap.cells[submap.geometry.offset(cell)];
    if (occupied == 0) continue;
    ++sum.known;
    sum.excess += (static_cast<double>(occupied) - kEvenPer255) / 255.0;
  }
  return sum;
}

/// Whether points as far as `reach_m` around a place may lie on the submap's grid.
bool may_be_seen(const Submap& submap, const Point2& p_submap, double reach_m) {
  const GridGeometry& grid = submap.geometry;
  const Point2 at = grid.in_cells(p_submap);
  const double reach = reach_m / grid.resolution_m;
  return at.x_m > -reach && at.x_m < grid.width + reach && at.y_m > -reach && at.y_m < grid.height + reach;
}

}  // namespace

void PlaceHypotheses::begin(const MotionBreak& motion_break) {
  break_ = motion_break;
  is_graph_corrected_ = false;
  queries_.clear();
  hypotheses_.clear();
}

/// The first keyframe is never pruned.
void PlaceHypotheses::begin_again(const IdRanges<KeyframeId>& pruned) {
  while (break_.moved_at && pruned.contains(*break_.moved_at))
    break_.moved_at = chain_->all().previous(*break_.moved_at);
  begin(break_);
}

/// So many contain the same travel, and count as one.
double PlaceHypotheses::queries_alike() const {
  return std::max(1.0, config_->multiscan_length_m / config_->tuning.places.way_between_m);
}

/// Log likelihood of a query by the mean of seen() over its points.
double PlaceHypotheses::likelihood_per_excess() const {
  return config_->tuning.matcher.likelihood_per_score / queries_alike();
}

PlaceHypotheses::Evidence PlaceHypotheses::evidence(Query& query, const Pose2& T_map_query,
                                                    std::span<const std::shared_ptr<const Submap>> submaps,
                                                    const PoseGraph& graph) const {
  const LoopDetectorTuning& window = config_->tuning.detector;
  const Submap* best = nullptr;
  std::size_t most = 0;
  for (const auto& submap : submaps) {
    if (submap->storey != chain_->storey(query.id)) continue;
    const Pose2 T_submap_query = between(graph.T_map_keyframe[submap->reference], T_map_query);
    if (!may_be_seen(*submap, T_submap_query.position(), query.reach_m)) continue;
    const std::size_t known = seen(*submap, query.points, T_submap_query).known;
    if (known > most) {
      most = known;
      best = submap.get();
    }
  }
  if (best == nullptr) return {};
  Pose2 T_submap_query = between(graph.T_map_keyframe[best->reference], T_map_query);
  Evidence found;
  const std::optional<MatchResult> match =
      CorrelativeMatcher(*best, query.points,
                         {T_submap_query, window.min_search_radius_m, window.min_search_angle_rad},
                         config_->tuning.matcher)
          .match(config_->min_score);
  if (match) {
    T_submap_query = match->T_submap_scan_best;
    found.match = LoopClosure{.from = best->reference,
                              .to = query.id,
                              .T_from_to = match->T_submap_scan,
                              .covariance = Covariance3::from_matrix(match->covariance),
                              .score = match->score};
  }
  found.log_likelihood = likelihood_per_excess() * seen(*best, query.points, T_submap_query).excess /
                         static_cast<double>(query.points.size());
  if (!match || found.log_likelihood <= 0.0 || query.cross_check.holds(*best, T_submap_query)) return found;
  return {};
}

/// By the returns since the query before: beams through walls are no hits. Those of scans 0.1 m apart count
/// for about half. What a map lacks, or a place that is off by a little, refutes no place at once: a query
/// takes no more than it gives. Where the estimate ran on nobody knows at which scan it went wrong, and those
/// before contradict the right place.
double PlaceHypotheses::against(const Query& query, const Pose2& T_map_query,
                                std::span<const std::shared_ptr<const Submap>> submaps,
                                const PoseGraph& graph) const {
  if (break_.moved_at) return 0.0;
  std::vector<Pose2> T_map_body;
  T_map_body.reserve(query.T_query_body.size());
  for (const Pose2& T_query_body : query.T_query_body) T_map_body.push_back(T_map_query * T_query_body);
  const double evidence = 0.5 * returns_.against(query.newer, T_map_body, 0.0, submaps, graph.T_map_keyframe);
  return std::clamp(evidence, 0.0, likelihood_per_excess() * kUsualExcess);
}

void PlaceHypotheses::weigh(Query& query, std::span<const std::shared_ptr<const Submap>> submaps,
                            const PoseGraph& graph, const KeyframePoses& T_path_keyframe,
                            Hypothesis& hypothesis) const {
  const Pose2& T_path_query = T_path_keyframe[query.id];
  const Evidence found = evidence(query, hypothesis.T_map_path * T_path_query, submaps, graph);
  const bool is_matched = found.match && found.log_likelihood > 0.0;
  const Pose2 T_map_query = is_matched ? graph.T_map_keyframe[found.match->from] * found.match->T_from_to
                                       : hypothesis.T_map_path * T_path_query;
  const double log_likelihood = found.log_likelihood - against(query, T_map_query, submaps, graph);
  hypothesis.log_likelihoods.push_back(log_likelihood);
  hypothesis.log_odds += log_likelihood;
  if (!is_matched || log_likelihood <= 0.0) return;
  hypothesis.matches.push_back(*found.match);
  hypothesis.T_map_path = T_map_query * T_path_query.inverse();  // dead reckoning drifts on the way
}

/// Where the travel's end lies decides; from there back dead reckoning drifts.
PlaceHypotheses::Hypothesis PlaceHypotheses::weighed_over_all(
    const Pose2& T_map_path, double prior, std::span<const std::shared_ptr<const Submap>> submaps,
    const PoseGraph& graph, const KeyframePoses& T_path_keyframe) {
  Hypothesis weighed{T_map_path, prior, {}, {}, false};
  for (std::size_t i = queries_.size(); i-- > 0;)
    weigh(queries_[i], submaps, graph, T_path_keyframe, weighed);
  weighed.T_map_path = T_map_path;
  std::ranges::reverse(weighed.log_likelihoods);
  std::ranges::reverse(weighed.matches);
  return weighed;
}

/// Of those that have come together the likeliest stays, as accepted if one of them was; in order of
/// likelihood.
void PlaceHypotheses::merge(const Pose2& T_path_query) {
  const PlaceHypothesesTuning& tuning = config_->tuning.places;
  std::stable_sort(hypotheses_.begin(), hypotheses_.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.log_odds > b.log_odds; });
  std::vector<Hypothesis> kept;
  for (Hypothesis& h : hypotheses_) {
    const Pose2 T_map_query = h.T_map_path * T_path_query;
    const auto alike = std::ranges::find_if(kept, [&](const Hypothesis& other) {
      return are_alike(other.T_map_path * T_path_query, T_map_query, config_->tuning.detector);
    });
    if (alike != kept.end()) {
      alike->is_accepted |= h.is_accepted;
    } else if (kept.size() < tuning.max_hypotheses) {
      kept.push_back(std::move(h));
    }
  }
  hypotheses_ = std::move(kept);
}

bool PlaceHypotheses::add_query(KeyframeId query, const ScanRange& recent,
                                std::span<const std::shared_ptr<const Submap>> submaps,
                                const PoseGraph& graph, const KeyframePoses& T_local_keyframe,
                                const KeyframePoses& T_path_keyframe) {
  const PlaceHypothesesTuning& tuning = config_->tuning.places;
  const double begins_m =
      queries_.empty() ? (*scans_)[recent.first].path_m : chain_->path_m(queries_.back().id);
  if (chain_->path_m(query) - begins_m < tuning.way_between_m) return false;
  Query taken{query, T_local_keyframe[query].yaw_rad(),
              thinned_hits(*scans_, *chain_, recent, T_local_keyframe, T_local_keyframe[query].inverse(),
                           config_->tuning.detector.thinning_cell_m),
              CrossCheck(*config_, *scans_, *chain_, recent, query, T_local_keyframe)};
  if (taken.points.size() < static_cast<std::size_t>(config_->min_match_points)) return false;
  taken.reach_m = farthest_m(taken.points, 0.0);
  taken.newer = recent;
  if (!queries_.empty()) taken.newer.first = std::max(recent.first, chain_->scan_of(queries_.back().id) + 1);
  const Pose2 T_query_local = T_local_keyframe[query].inverse();
  for (const Pose2& T_local_body : chain_->T_w_bodies(taken.newer, T_local_keyframe))
    taken.T_query_body.push_back(T_query_local * T_local_body);
  const Pose2 T_map_path = graph.T_map_keyframe[query] * T_path_keyframe[query].inverse();
  const double prior = std::log(tuning.not_moved_odds) - break_.log_odds_moved;
  if (hypotheses_.empty()) hypotheses_.push_back({T_map_path, prior, {}, {}, false});
  for (Hypothesis& h : hypotheses_)
    if (h.is_accepted) h.T_map_path = T_map_path;
  if (queries_.size() == tuning.max_queries) forget_oldest();
  for (Hypothesis& h : hypotheses_) weigh(taken, submaps, graph, T_path_keyframe, h);
  queries_.push_back(std::move(taken));
  if (std::exchange(is_graph_corrected_, false))
    hypotheses_.push_back(weighed_over_all(T_map_path, prior, submaps, graph, T_path_keyframe));
  merge(T_path_keyframe[query]);
  return true;
}

/// What told hypotheses apart stays with them. One that comes later counts as if it had explained the query
/// as well as the likeliest.
void PlaceHypotheses::forget_oldest() {
  const KeyframeId oldest = queries_.front().id;
  queries_.pop_front();
  const double of_likeliest = hypotheses_.front().log_likelihoods.front();
  for (Hypothesis& h : hypotheses_) {
    h.log_odds -= of_likeliest;
    h.log_likelihoods.erase(h.log_likelihoods.begin());
    std::erase_if(h.matches, [&](const LoopClosure& match) { return match.to == oldest; });
  }
}

/// Behind an estimate that ran on: of what tracking takes for one place and heading. The vehicle turned by
/// any angle up to a quarter more than its estimate says, or as often not at all: most corridors and many
/// buildings look the same after half a turn. How far it moved has no scale beyond that of a slip (Student's
/// t with one degree of freedom).
double PlaceHypotheses::log_prior(const Pose2& T_map_path, KeyframeId query, double drift_m,
                                  std::size_t submaps, const PoseGraph& graph,
                                  const KeyframePoses& T_path_keyframe) const {
  const PlaceHypothesesTuning& tuning = config_->tuning.places;
  const KeyframeId since = break_.moved_at.value_or(query);
  const Pose2 moved = between(graph.T_map_keyframe[since], T_map_path * T_path_keyframe[since]);
  const double far_m = std::hypot(moved.x_m(), moved.y_m());
  const double slip_m = tuning.unmoved_reach_m;
  const double carried_m = tuning.carrying_speed_m_per_s * to_seconds(break_.unwatched);
  if (far_m > slip_m + carried_m + drift_m) return kImpossible;
  if (!break_.moved_at) return -std::log(tuning.places_per_submap * static_cast<double>(submaps));
  if (std::abs(moved.yaw_rad()) > kMaxTurnRad) return kImpossible;
  const LoopDetectorTuning& window = config_->tuning.detector;
  const bool is_turned = std::abs(moved.yaw_rad()) > window.min_search_angle_rad;
  const double heading = 0.5 * window.min_search_angle_rad / kMaxTurnRad + (is_turned ? 0.0 : 0.5);
  const double width = 2.0 * window.min_search_radius_m / slip_m;
  return std::log(heading * width * width / (2.0 * kPi)) -
         1.5 * std::log1p(far_m * far_m / (slip_m * slip_m));
}

/// Across a silence the graph has the travel where the estimate led: as far off as it may be by its
/// covariance.
double PlaceHypotheses::drift_m(const LoopClosure& match, const PoseGraph& graph) const {
  if (!break_.estimate_ran_on) return 0.0;
  const auto covariances = relative_covariances(graph, match.to, config_->tuning.covariance);
  const Pose2 T_query_submap = between(graph.T_map_keyframe[match.to], graph.T_map_keyframe[match.from]);
  const Eigen::Matrix3d J = jacobian_inverse(T_query_submap);
  const Eigen::Matrix3d P = J * covariances[match.from] * J.transpose();
  return config_->tuning.detector.search_sigmas * std::sqrt(std::max(P(0, 0), P(1, 1)));
}

/// By so little at a time that one of the turns is within what evidence() searches.
std::vector<LoopClosure> PlaceHypotheses::turned(std::span<const std::shared_ptr<const Submap>> submaps,
                                                 const PoseGraph& graph,
                                                 const KeyframePoses& T_path_keyframe) {
  std::vector<LoopClosure> matches;
  if (!break_.moved_at || queries_.empty()) return matches;
  const LoopDetectorTuning& window = config_->tuning.detector;
  const Pose2 way = between(T_path_keyframe[*break_.moved_at], T_path_keyframe[queries_.back().id]);
  const double way_m = std::hypot(way.x_m(), way.y_m());
  const double radius_m = window.min_search_radius_m;
  const double step_rad = 2.0 * config_->tuning.matcher.edge_of_window *
                          std::min(window.min_search_angle_rad, radius_m / std::max(way_m, radius_m));
  const int steps = static_cast<int>(kMaxTurnRad / step_rad);
  for (int i = -steps; i <= steps; ++i) {
    if (i == 0) continue;
    const Pose2 T_map_query = graph.T_map_keyframe[*break_.moved_at] * Pose2(0.0, 0.0, i * step_rad) * way;
    const Evidence found = evidence(queries_.back(), T_map_query, submaps, graph);
    if (found.match && found.log_likelihood > 0.0) matches.push_back(*found.match);
  }
  return matches;
}

void PlaceHypotheses::propose(const LoopClosure& match,
                              std::span<const std::shared_ptr<const Submap>> submaps, const PoseGraph& graph,
                              const KeyframePoses& T_path_keyframe) {
  if (queries_.empty()) return;
  const Pose2& T_path_query = T_path_keyframe[match.to];
  const Pose2 T_map_query = graph.T_map_keyframe[match.from] * match.T_from_to;
  for (const Hypothesis& h : hypotheses_)
    if (are_alike(h.T_map_path * T_path_query, T_map_query, config_->tuning.detector)) return;
  const Pose2 T_map_path = T_map_query * T_path_query.inverse();
  const double prior =
      log_prior(T_map_path, match.to, drift_m(match, graph), submaps.size(), graph, T_path_keyframe);
  if (prior == kImpossible) return;
  hypotheses_.push_back(weighed_over_all(T_map_path, prior, submaps, graph, T_path_keyframe));
  merge(T_path_query);
}

/// Of the position that the matches give, in the worst direction, which is along a corridor.
double PlaceHypotheses::sigma_m(const Hypothesis& hypothesis) const {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (const LoopClosure& match : hypothesis.matches) {
    const auto query = std::ranges::find(queries_, match.to, &Query::id);
    const Eigen::Matrix2d R =
        Eigen::Rotation2Dd(query->yaw_local_rad - match.T_from_to.yaw_rad()).toRotationMatrix();
    const Eigen::Matrix2d position = match.covariance.matrix().topLeftCorner<2, 2>();
    information += R * position.inverse() * R.transpose() / queries_alike();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(information, Eigen::EigenvaluesOnly);
  return 1.0 / std::sqrt(std::max(solver.eigenvalues()(0), 1e-9));
}

double PlaceHypotheses::lead() const {
  const double rival = hypotheses_.size() < 2 ? 0.0 : std::max(0.0, hypotheses_[1].log_odds);
  return hypotheses_.front().log_odds - rival;
}

std::vector<LoopClosure> PlaceHypotheses::decided() const {
  const PlaceHypothesesTuning& tuning = config_->tuning.places;
  if (hypotheses_.empty()) return {};
  const Hypothesis& likeliest = hypotheses_.front();
  if (likeliest.is_accepted || static_cast<double>(likeliest.matches.size()) < queries_alike()) return {};
  if (lead() < tuning.sure_log_odds || sigma_m(likeliest) > tuning.max_sigma_m) return {};
  return likeliest.matches;
}

void PlaceHypotheses::accept_likeliest() {
  for (Hypothesis& h : hypotheses_) h.is_accepted = false;
  hypotheses_.front().is_accepted = true;
}

bool PlaceHypotheses::is_refuted() const {
  const auto accepted = std::ranges::find_if(hypotheses_, &Hypothesis::is_accepted);
  return accepted == hypotheses_.end() || accepted->log_odds < -config_->tuning.places.sure_log_odds;
}

bool PlaceHypotheses::is_beyond_doubt() const {
  return hypotheses_.front().is_accepted && lead() > 2.0 * config_->tuning.places.sure_log_odds;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/refinement/run_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/backend/refinement/batch_refinement.hpp"
#include "core/backend/refinement/map_evidence.hpp"
#include "core/backend/refinement/point_to_line_factor.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensing/odometry_covariance.hpp"
#include "core/sensing/systematic_motion.hpp"

namespace swiftlet {
namespace {

/// As DCS weighted it last.
template <typename Factor>
void scale_information(Factor& factor) {
  factor.information *= factor.dcs_scale * factor.dcs_scale;
}

/// Of those that lead from one range to the other. Motions in doubt are part of dead reckoning.
std::vector<RelativePoseFactor<ScanId>> closures_between_scans(const PoseGraph& graph,
                                                               const KeyframeChain& chain,
                                                               const ScanRange& range_from,
                                                               const ScanRange& range_to) {
  std::vector<RelativePoseFactor<ScanId>> closures;
  for (const auto& [id, f] : graph.factors) {
    if (!f.is_closure || f.information.isZero(0.0) || std::ranges::count(graph.doubted, id) > 0) continue;
    const ScanId from = chain.scan_of(f.from);
    const ScanId to = chain.scan_of(f.to);
    if (!range_from.contains(from) || !range_to.contains(to)) continue;
    closures.push_back(f.joining(from, to));
    scale_information(closures.back());
  }
  return closures;
}

std::vector<HeadingFactor<ScanId>> headings_of_scans(const PoseGraph& graph, const KeyframeChain& chain,
                                                     const ScanRange& range) {
  std::vector<HeadingFactor<ScanId>> headings;
  for (const HeadingFactor<KeyframeId>& f : graph.headings) {
    if (!range.contains(chain.scan_of(f.pose))) continue;
    headings.push_back(f.of(chain.scan_of(f.pose)));
    scale_information(headings.back());
  }
  return headings;
}

/// By how many of its standard errors `misfit` is less than the other, traversals being taken as independent.
double gain_sigmas(std::span<const double> misfit, std::span<const double> other) {
  double gain = 0.0;
  double variance = 0.0;
  for (std::size_t i = 0; i < misfit.size(); ++i) {
    const double difference = other[i] - misfit[i];
    gain += difference;
    variance += difference * difference;
  }
  return variance > 0.0 ? gain / std::sqrt(variance) : 0.0;
}

double sum(std::span<const double> misfit) { return std::accumulate(misfit.begin(), misfit.end(), 0.0); }

double rms_distance_m(std::span<const Pose2> a, std::span<const Pose2> b) {
  double sum_m2 = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum_m2 += (a[i].x_m() - b[i].x_m()) * (a[i].x_m() - b[i].x_m()) +
              (a[i].y_m() - b[i].y_m()) * (a[i].y_m() - b[i].y_m());
  return std::sqrt(sum_m2 / static_cast<double>(a.size()));
}

/// The same path, beginning at another pose.
std::vector<Pose2> from(const Pose2& T_map_first, std::vector<Pose2> path) {
  const Pose2 T_map_path = T_map_first * path.front().inverse();
  for (Pose2& T : path) T = T_map_path * T;
  return path;
}

/// The odometry's path from the first scan.
std::vector<Pose2> reported_path(std::span<const StoredScan> scans, const OdometryCalibration& calibration) {
  std::vector<Pose2> T_first_body{Pose2()};
  for (std::size_t i = 1; i < scans.size(); ++i)
    T_first_body.push_back(T_first_body.back() * reported_motion(scans[i - 1], scans[i], calibration));
  return T_first_body;
}

}  // namespace

RunRefinement::RunRefinement(const BackendConfig& config, const SensorModel& sensor, const ScanStore& scans,
                             const KeyframeChain& chain)
    : config_(&config),
      sensor_(sensor),
      scans_(&scans),
      chain_(&chain),
      online_(scans, chain, sensor, config.tuning) {}

void RunRefinement::follow(const KeyframePoses& T_map_keyframe) {
  if (is_wanted()) online_.follow(T_map_keyframe);
}

ScanRange RunRefinement::refine_window(const PoseGraph& graph, const KeyframePoses& T_local_keyframe) {
  if (!is_wanted() || !config_->refine_online) return {};
  const Result<ScanRange> refined =
      online_.step(graph.T_map_keyframe, T_local_keyframe, doubted_motions(graph, *chain_));
  if (refined) return *refined;
  ++counters_.solver_failures;
  return {};
}

ScanRange RunRefinement::newest_stretch() const {
  const IdMap<ScanId, StoredScan>& scans = scans_->all();
  const std::size_t count = std::min(scans.size(), config_->tuning.online.max_stretch_scans);
  return {scans.id_at(scans.size() - count), scans.end_id()};
}

/// Closures of less travel than a query's are made of the same returns. As many of these as four beams have.
bool RunRefinement::refine_stretch(const PoseGraph& graph, bool has_closed) {
  if (!is_wanted() || !config_->refine_online) return false;
  const bool moved = take_stretch(graph.T_map_keyframe);
  has_closed_ |= has_closed;
  const double here_m = chain_->path_m(chain_->all().last_id());
  const bool is_soon =
      stretch_begun_m_ && here_m - *stretch_begun_m_ < config_->tuning.detector.newer_query_m;
  if (!has_closed_ || is_soon || stretch_.is_busy()) return moved;
  has_closed_ = false;
  stretch_begun_m_ = here_m;
  const ScanRange stretch = newest_stretch();
  const Known known = known_of_stretch(graph, stretch);
  stretch_.begin({.scans = *scans_,
                  .sensor = sensor_,
                  .closures = known.closures,
                  .headings = known.headings,
                  .doubted = known.doubted,
                  .config = *config_,
                  .range = stretch,
                  .max_returns = 4 * config_->tuning.online.max_stretch_scans},
                 chain_->T_w_bodies(stretch, graph.T_map_keyframe), online_.T_graph_refined(stretch).front());
  return moved;
}

void RunRefinement::continue_stretch() {
  if (const Status status = stretch_.step(); !status) ++counters_.solver_failures;
}

bool RunRefinement::take_stretch(const KeyframePoses& T_map_keyframe) {
  if (!stretch_.is_solved()) return false;
  const std::optional<StretchRefinement::Found> found = stretch_.finish();
  if (!found) {
    ++counters_.stretches_refused;
    return false;
  }
  ++counters_.stretches_refined;
  online_.take_offsets(found->scans, found->T_graph_refined, T_map_keyframe);
  return true;
}

RunRefinement::Hypothesis RunRefinement::hypothesis(MapSource source, const PoseGraph& graph,
                                                    const KeyframePoses& T_local_keyframe) const {
  const ScanRange all{scans_->all().first_id(), scans_->all().end_id()};
  std::vector<Pose2> T_map_body = chain_->T_w_bodies(all, graph.T_map_keyframe);
  const Pose2 T_map_first = T_map_body.front();
  if (source == MapSource::kFrontend)
    T_map_body = from(T_map_first, chain_->T_w_bodies(all, T_local_keyframe));
  if (source == MapSource::kDeadReckoning)
    T_map_body = from(T_map_first, reported_path(scans_->all().values(), sensor_.calibration_as_reported()));
  return {.source = source, .T_map_body = std::move(T_map_body)};
}

RunRefinement::Known RunRefinement::known_of(const PoseGraph& graph, const ScanRange& range) const {
  return {closures_between_scans(graph, *chain_, range, range), headings_of_scans(graph, *chain_, range),
          doubted_motions(graph, *chain_)};
}

/// Where a closure begins before the stretch, the first scan of that, which is held, stands for its
/// beginning.
RunRefinement::Known RunRefinement::known_of_stretch(const PoseGraph& graph, const ScanRange& stretch) const {
  Known known = known_of(graph, stretch);
  const Pose2 T_first_map = T_map_body(stretch.first, graph.T_map_keyframe).inverse();
  const ScanRange before{scans_->all().first_id(), stretch.first};
  const ScanRange behind_first{scans_->all().at_or_after(stretch.first + 1), stretch.end};
  for (RelativePoseFactor<ScanId> closure : closures_between_scans(graph, *chain_, before, behind_first)) {
    closure.T_from_to = T_first_map * T_map_body(closure.from, graph.T_map_keyframe) * closure.T_from_to;
    closure.from = stretch.first;
    known.closures.push_back(closure);
  }
  if (stretch.first != scans_->all().first_id()) add_ties(graph, stretch, known);
  return known;
}

/// What lies before the stretch the graph knows: where no wall says otherwise each keyframe stays about where
/// it is. The joint steps weigh closures by closure_weight; ties, which no returns share, count in full
/// there.
void RunRefinement::add_ties(const PoseGraph& graph, const ScanRange& stretch, Known& known) const {
  const RefinementTuning& tuning = config_->tuning.refinement;
  const OdometrySigma sigma{tuning.tie_sigma_m, tuning.tie_sigma_rad};
  const Pose2 T_first_map = chain_->T_w_body(stretch.first, graph.T_map_keyframe).inverse();
  for (const auto& [keyframe, scan] : chain_->all()) {
    if (scan <= stretch.first) continue;
    RelativePoseFactor<ScanId> tie{stretch.first, scan, T_first_map * graph.T_map_keyframe[keyframe]};
    tie.information = (sigma.information() / config_->tuning.joint.closure_weight).asDiagonal();
    known.closures.push_back(tie);
  }
}

/// Closures and headings are the graph's own path's. A motion that the run has refuted is none for a run that
/// was mapped again either.
RunRefinement::Known RunRefinement::known_of(const Hypothesis& hypothesis, const PoseGraph& graph) const {
  if (hypothesis.source == MapSource::kDeadReckoning || hypothesis.source == MapSource::kFrontend) return {};
  if (hypothesis.source != MapSource::kPoseGraph) return {{}, {}, doubted_motions(graph, *chain_)};
  return known_of(graph, {scans_->all().first_id(), scans_->all().end_id()});
}

BatchRefinement RunRefinement::batch(const Hypothesis& hypothesis, const Known& known) const {
  return {
      *scans_,
      sensor_,
      known.closures,
      known.headings,
      known.doubted,
      *config_,
      hypothesis.source == MapSource::kDeadReckoning ? DeadReckoning::kAsReported : DeadReckoning::kLessDrift,
      hypothesis.floor.step_scale};
}

/// The odometry is left as reported unless that is significantly worse.
bool RunRefinement::try_refine(Hypothesis& hypothesis, const PoseGraph& graph) {
  const Known known = known_of(hypothesis, graph);
  std::vector<Pose2> T_refined = hypothesis.T_map_body;
  Result<RefinementReport> report = refine_in_turn(batch(hypothesis, known), T_refined);
  if (!report) {
    ++counters_.solver_failures;
    return false;
  }
  RefinementReport& r = hypothesis.report = std::move(*report);
  if (hypothesis.source == MapSource::kDeadReckoning &&
      gain_sigmas(r.misfit, r.misfit_at_start) < config_->tuning.refinement.refined_gain_sigmas) {
    r.misfit = r.misfit_at_start;
    r.accepted = false;
  } else {
    hypothesis.T_map_body = std::move(T_refined);
  }
  return true;
}

/// Dead reckoning that stays as reported is left alone.
void RunRefinement::complete(Hypothesis& hypothesis, const PoseGraph& graph) {
  if (hypothesis.source == MapSource::kDeadReckoning && !hypothesis.report.accepted) return;
  const Known known = known_of(hypothesis, graph);
  if (!refine_together(batch(hypothesis, known), hypothesis.report, hypothesis.T_map_body))
    ++counters_.solver_failures;
}

/// By the log odds: those beforehand, which are against a correction where the place has no walls to correct
/// by, and even for a frontend whose pose graph has lost; what the ranges give (those of a standard normal
/// variable), as far as they meet walls again; against dead reckoning that errs as far as the two lie apart,
/// which each further median error makes half as likely.
bool RunRefinement::is_likelier(const Hypothesis& hypothesis, const Hypothesis& simpler) const {
  const RefinementTuning& tuning = config_->tuning.refinement;
  const double z = gain_sigmas(hypothesis.report.misfit, simpler.report.misfit);
  const double way_m = scans_->all().values().back().path_m - scans_->all().values().front().path_m;
  const double apart = rms_distance_m(hypothesis.T_map_body, simpler.T_map_body) / std::max(way_m, 1.0);
  double log_odds_before = 0.0;
  if (hypothesis.source == MapSource::kPoseGraph) {
    const double walled = share_on_walls_of_any(batch(hypothesis, {}), hypothesis.T_map_body);
    log_odds_before = (2.0 * walled - 1.0) * std::log(tuning.correction_odds);
  }
  return log_odds_before + hypothesis.report.share_on_walls * 0.5 * z * std::abs(z) >
         std::log(2.0) * apart / tuning.median_drift;
}

/// Refined. Nothing where there is no solution.
std::optional<RunRefinement::Hypothesis> RunRefinement::best_of_run(const PoseGraph& graph,
                                                                    const KeyframePoses& T_local_keyframe) {
  std::optional<Hypothesis> best;
  Hypothesis simplest = hypothesis(MapSource::kDeadReckoning, graph, T_local_keyframe);
  if (try_refine(simplest, graph)) best = std::move(simplest);
  for (const MapSource source : {MapSource::kPoseGraph, MapSource::kFrontend}) {
    Hypothesis correction = hypothesis(source, graph, T_local_keyframe);
    if (!try_refine(correction, graph) || (best && !is_likelier(correction, *best))) continue;
    best = std::move(correction);
    break;
  }
  if (best) complete(*best, graph);
  return best;
}

/// All that the run says against a path, in nats. The misfit alone does not know a corridor that is drawn
/// twice: its returns lie on walls of their own neighbours.
double RunRefinement::cost_of(const Hypothesis& path, const RefinementReport& judged) const {
  const double cell_m =
      8.0 * config_->tuning.refinement.wall_sigma_m;  // twice what one wall's returns scatter
  return judged.misfit_of_path - map_log_evidence(*scans_, path.T_map_body, cell_m);
}

/// All are judged as they are: refine_together() has corrected the dead reckoning that the best one was
/// judged by.
void RunRefinement::take_better(std::span<const OtherPath> others, Hypothesis& best) const {
  if (others.empty()) return;
  double least = cost_of(best, judge_as_it_is(batch(best, {}), best.T_map_body));
  for (const OtherPath& other : others) {
    Hypothesis correction{.source = other.source,
                          .T_map_body = from(best.T_map_body.front(), other.T_map_body),
                          .yaw_noise_factor = other.yaw_noise_factor,
                          .floor = best.floor};
    correction.report = judge_as_it_is(batch(correction, {}), correction.T_map_body);
    correction.report.held_out_before_m = best.report.held_out_before_m;
    const double cost = cost_of(correction, correction.report);
    if (cost >= least) continue;
    least = cost;
    best = std::move(correction);
  }
}

/// Dead reckoning that stays as reported is left alone.
bool RunRefinement::may_find_floor(const Hypothesis& best) const {
  return config_->floor_varies && !yaw_goes_with_travel(sensor_.odometry) &&
         (best.source != MapSource::kDeadReckoning || best.report.accepted);
}

/// Where they differ by so much that it was worth its cost.
bool RunRefinement::find_floor(Hypothesis& best, const PoseGraph& graph) {
  Hypothesis on_floor = best;
  const Known known = known_of(best, graph);
  Result<FloorFindings> floor =
      refine_together_with_floor(batch(best, known), on_floor.report, on_floor.T_map_body);
  if (!floor) ++counters_.solver_failures;
  if (!floor || floor->cost < config_->tuning.floor.min_cost) return false;
  best = std::move(on_floor);
  best.floor = std::move(*floor);
  return true;
}

void RunRefinement::take(Hypothesis best) {
  counters_.held_out_before_m = best.report.held_out_before_m;
  counters_.held_out_after_m = best.report.held_out_after_m;
  counters_.refined = best.report.accepted;
  counters_.map_source = best.source;
  counters_.yaw_noise_factor = best.yaw_noise_factor;
  counters_.floor_cost = best.floor.cost;
  counters_.misfit = sum(best.report.misfit);
  T_map_refined_ = scans_->all().with(std::move(best.T_map_body));
}

/// Where dead reckoning is the map it stays: each other path would be one more chance to beat it by luck.
bool RunRefinement::refine_all(const PoseGraph& graph, const KeyframePoses& T_local_keyframe,
                               const MapAgain& map_again) {
  if (!is_wanted() || scans_->size() < 2) return false;
  std::optional<Hypothesis> best = best_of_run(graph, T_local_keyframe);
  if (!best) return false;
  const bool again = map_again && best->source != MapSource::kDeadReckoning;
  if (again) take_better(map_again({}), *best);
  if (may_find_floor(*best) && find_floor(*best, graph) && again)
    take_better(map_again(best->floor.step_scale), *best);
  take(std::move(*best));
  return is_final();
}

void RunRefinement::erase(const IdRanges<ScanId>& scans, const IdRanges<TraversalId>& traversals) {
  online_.erase(scans, traversals);
  if (!stretch_.is_busy()) return;
  stretch_.abandon();
  has_closed_ = true;
  stretch_begun_m_.reset();
}

Pose2 RunRefinement::T_map_body(ScanId scan, const KeyframePoses& T_map_keyframe) const {
  if (is_final()) return T_map_refined_[scan];
  return online_.refined(scan, chain_->T_w_body(scan, T_map_keyframe));
}

Pose2 RunRefinement::T_map_newest(const KeyframePoses& T_map_keyframe,
                                  const KeyframePoses& T_local_keyframe) const {
  const std::span<const ScanId> scans = chain_->all().values();
  const Pose2 T_map_tip = T_map_body(scans.back(), T_map_keyframe);
  if (!is_wanted() || is_final()) return T_map_tip;
  const std::span<const Pose2> T_local = T_local_keyframe.values();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // of differences from the tip
  std::size_t count = 0;
  const std::size_t most = config_->tuning.online.keyframes_of_correction;
  for (std::size_t k = scans.size(); k-- > 0 && count < most;) {
    const Pose2 T_map_seen = T_map_body(scans[k], T_map_keyframe) * between(T_local[k], T_local.back());
    sum += Eigen::Vector3d(T_map_seen.x_m() - T_map_tip.x_m(), T_map_seen.y_m() - T_map_tip.y_m(),
                           wrap_angle(T_map_seen.yaw_rad() - T_map_tip.yaw_rad()));
    ++count;
    if ((*scans_)[scans[k]].starts_segment) break;
  }
  const Eigen::Vector3d mean = sum / static_cast<double>(count);
  return {T_map_tip.x_m() + mean(0), T_map_tip.y_m() + mean(1), T_map_tip.yaw_rad() + mean(2)};
}

RefinementCounters RunRefinement::counters() const {
  RefinementCounters counters = counters_;
  counters.windows_refined = online_.windows_refined();
  counters.windows_refused = online_.windows_refused();
  return counters;
}

}  // namespace swiftlet

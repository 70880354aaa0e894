// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/backend.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "core/backend/confidence/map_agreement.hpp"
#include "core/backend/confidence/pose_covariances.hpp"
#include "core/backend/confidence/recent_innovation.hpp"
#include "core/backend/loop_closing/loop_closer.hpp"
#include "core/backend/loop_closing/return_evidence.hpp"
#include "core/backend/pose_graph/keyframe_graph.hpp"
#include "core/backend/refinement/run_refinement.hpp"

namespace swiftlet {

struct Backend::State {
  State(const BackendConfig& backend_config, const SensorModel& sensor, const BeamLayout& beams)
      : config(backend_config), scans(beams), refinement(config, sensor, scans, chain) {}

  [[nodiscard]] const KeyframePoses& T_local_keyframe() const { return estimates.T_local_keyframe(); }
  [[nodiscard]] const KeyframePoses& T_map_keyframe() const { return graph.T_map_keyframe(); }
  bool follow_graph(bool has_moved);
  bool refine_stretch(const BackendUpdate& update);
  ScanRange refine_window(const BackendUpdate& update);
  void drop_closures_off_map();
  void correct_newest(const Pose2& T_local_body);
  void compare_newest_scan(const FrontendStep& step);
  [[nodiscard]] double evidence_since(KeyframeId since, const KeyframePoses& T_map_seen_from,
                                      std::span<const std::shared_ptr<const Submap>> submaps) const;
  /// The returns of scans 0.1 m apart count for half of what they would if they were independent.
  [[nodiscard]] double evidence_of_alarm() const { return 0.5 * config.tuning.confidence.alarm_log_odds; }
  [[nodiscard]] bool newest_contact_is_at_fault() const;
  [[nodiscard]] KeyframeId recent_since() const;
  [[nodiscard]] bool is_explained(KeyframeId contradicted_since) const;
  bool doubt_motion_if_contradicted();
  bool end_doubt();
  [[nodiscard]] bool has_restarted_unplaced() const;
  [[nodiscard]] std::optional<KeyframeId> unsure_since() const;
  [[nodiscard]] Tracking tracking() const;
  [[nodiscard]] PoseConfidence computed_confidence() const;

  BackendConfig config;
  ScanStore scans;
  KeyframeChain chain{scans};
  FrontendEstimates estimates;
  KeyframeGraph graph{config, chain};
  LoopCloser loops{config, scans, chain};
  RunRefinement refinement;
  Pruner pruner{config, scans, chain};
  MapAgreement agreement{config.tuning.confidence, scans};
  RecentInnovation innovation;
  MapCorrection correction;  // at the newest keyframe
  std::optional<PoseConfidence>
      confidence;                // as it was last computed; nothing once it does not hold any more
  double confidence_at_m = 0.0;  // the travel then
  bool is_in_doubt = false;      // a contradiction that is not over has put a motion in doubt
  std::uint32_t version = 0;     // counts up whenever earlier keyframes have moved
  std::uint64_t scans_pruned = 0;
};

bool Backend::State::follow_graph(bool has_moved) {
  if (!has_moved) return false;
  ++version;
  loops.take_scales(graph.graph());
  return true;
}

bool Backend::State::refine_stretch(const BackendUpdate& update) {
  if (!refinement.refine_stretch(graph.graph(), update.new_closures > 0)) return false;
  ++version;
  return true;
}

ScanRange Backend::State::refine_window(const BackendUpdate& update) {
  if (update.poses_changed) refinement.follow(T_map_keyframe());
  const ScanRange refined = refinement.refine_window(graph.graph(), T_local_keyframe());
  if (!refined.empty()) ++version;
  return refined;
}

/// Of the final map: where that is another path's, it was found without them.
void Backend::State::drop_closures_off_map() {
  KeyframePoses T_map_refined = T_map_keyframe();
  for (const auto& [keyframe, scan] : chain.all())
    T_map_refined[keyframe] = refinement.T_map_body(scan, T_map_keyframe());
  loops.drop_those_off(T_map_refined, graph);
}

/// At the newest keyframe. What contradicts a pose is no evidence against the one it is corrected to.
void Backend::State::correct_newest(const Pose2& T_local_body) {
  const Pose2 T_map_newest = refinement.T_map_newest(T_map_keyframe(), T_local_keyframe());
  const Point2 was = correction.T_map_local * T_local_body.position();
  correction = {chain.all().last_id(), T_map_newest * T_local_keyframe().values().back().inverse(), version};
  const Point2 is = correction.T_map_local * T_local_body.position();
  if (distance_m(was, is) > config.tuning.confidence.tolerance_m) agreement.begin_again();
}

/// With the older map, at the pose that the newest correction gives it.
void Backend::State::compare_newest_scan(const FrontendStep& step) {
  const Pose2 T_map_body = correction.T_map_local * step.T_local_body;
  if (step.has_keyframe)
    agreement.look_around(T_map_body, chain.path_m(step.made.id), step.sample.storey, loops.submaps(),
                          T_map_keyframe());
  if (!has_restarted_unplaced()) agreement.add_newest_scan(T_map_body);
}

/// Against these submaps, those of long before, of the travel since a keyframe seen from these poses.
double Backend::State::evidence_since(KeyframeId since, const KeyframePoses& T_map_seen_from,
                                      std::span<const std::shared_ptr<const Submap>> submaps) const {
  const ScanRange scans_since{chain.scan_of(since), scans.all().end_id()};
  return ReturnEvidence(config.tuning.confidence, scans)
      .against(scans_since, chain.T_w_bodies(scans_since, T_map_seen_from),
               config.tuning.confidence.old_after_m, submaps, T_map_keyframe());
}

/// Where older ground is met again, the first closures are matched in a wide window with the edge of what is
/// known, and the next ones confirm them. They are at fault where the travel since would contradict the older
/// map less without them.
bool Backend::State::newest_contact_is_at_fault() const {
  const std::optional<LoopCloser::Contact> contact = loops.contact_that_moved(graph.graph());
  if (!contact) return false;
  KeyframePoses T_map_without = T_map_keyframe();
  const KeyframePoses& T_local = T_local_keyframe();
  for (KeyframeId k = contact->since; k < chain.all().end_id(); k = chain.all().at_or_after(k + 1))
    T_map_without[k] = contact->T_map_since * between(T_local[contact->since], T_local[k]);
  const double corrected = evidence_since(contact->since, T_map_keyframe(), loops.submaps());
  return corrected > evidence_since(contact->since, T_map_without, loops.submaps()) + evidence_of_alarm();
}

/// The loops that were closed meanwhile tell which motion was wrong. True: the poses have moved.
bool Backend::State::end_doubt() {
  loops.end_doubt();
  if (!std::exchange(is_in_doubt, false)) return false;
  if (!graph.release_bent_motion()) return false;
  confidence.reset();
  if (!follow_graph(graph.settle())) return false;
  refinement.follow(T_map_keyframe());
  return true;
}

/// Where the newest travel begins that is no older map to itself.
KeyframeId Backend::State::recent_since() const {
  const std::span<const ScanId> made_by = chain.all().values();
  const double from_m = scans[made_by.back()].path_m - config.tuning.confidence.old_after_m;
  const auto is_before = [&](ScanId scan) { return scans[scan].path_m < from_m; };
  const auto first = std::ranges::partition_point(made_by, is_before);
  return chain.all().id_at(static_cast<std::size_t>(first - made_by.begin()));
}

/// By travel that has no place, or none beyond doubt. A silence explains what contradicts the map of before
/// it; what contradicts the ground flown since is another fault. On new ground no place ends a silence, so
/// the newest travel alone is weighed, whatever agreed before it.
bool Backend::State::is_explained(KeyframeId contradicted_since) const {
  const std::optional<KeyframeId> unplaced = loops.unplaced_since();
  if (!unplaced || loops.unplaced_by() != UnplacedBy::kSilence) return loops.weighs_places();
  return contradicted_since <= *unplaced ||
         evidence_since(std::max(contradicted_since, recent_since()), T_map_keyframe(),
                        loops.submaps_since(*unplaced)) < evidence_of_alarm();
}

/// A jump, a slip or a carried vehicle that no input reports: behind the last agreement with the older map.
/// True: the poses have moved. They do so at once where a contact was dropped: the next loops are looked for
/// from there.
bool Backend::State::doubt_motion_if_contradicted() {
  if (!agreement.is_contradicted()) return end_doubt();
  const ScanId agreed = scans.all().at_or_after(agreement.agreed_last());  // it may have been pruned
  const KeyframeId first = chain.all().at_or_after(scans[agreed].keyframe + 1);
  if (first >= chain.all().end_id() || is_explained(first)) return false;
  const bool is_at_fault = newest_contact_is_at_fault();
  if (is_at_fault) loops.drop_contact(graph);
  graph.doubt_motion_to(first);
  is_in_doubt = true;
  loops.doubt_since(first, evidence_of_alarm());
  confidence.reset();
  if (!is_at_fault || !follow_graph(graph.settle())) return false;
  refinement.follow(T_map_keyframe());
  return true;
}

/// Across a break with known motion (the vehicle's estimate ran on) only the covariance grows.
bool Backend::State::has_restarted_unplaced() const {
  return loops.unplaced_since() && loops.unplaced_by() == UnplacedBy::kRestart;
}

/// Where the travel begins that has no place behind a restart, or one that is not beyond doubt.
std::optional<KeyframeId> Backend::State::unsure_since() const {
  return has_restarted_unplaced() ? loops.unplaced_since() : loops.provisional_since();
}

Tracking Backend::State::tracking() const {
  if (has_restarted_unplaced() && loops.places_weighed() < 2) return Tracking::kLost;
  if (unsure_since()) return Tracking::kRelocalizing;
  return agreement.is_contradicted() ? Tracking::kUncertain : Tracking::kTracking;
}

PoseConfidence Backend::State::computed_confidence() const {
  const ConfidenceTuning& tuning = config.tuning.confidence;
  const PoseCovariances covariances = newest_pose_covariances(graph.graph(), chain, config.tuning);
  return {.keyframe = correction.keyframe,
          .T_local_keyframe = T_local_keyframe().values().back(),
          .yaw_map_local_rad = correction.T_map_local.yaw_rad(),
          .from_start = covariances.from_start,
          .from_surroundings = covariances.from_surroundings,
          .slip = {tuning.slip_along_m2_per_m, tuning.slip_yaw_rad2_per_m},
          .has_older_map = false,
          .figures = {}};
}

Backend::Backend(const BackendConfig& config, const SensorModel& sensor, const BeamLayout& beams) {
  SWIFTLET_CHECK(config.validate().empty(), "the backend's configuration is valid");
  state_ = std::make_unique<State>(config, sensor, beams);
}
Backend::~Backend() = default;

BackendUpdate Backend::add(const FrontendStep& step) {
  State& s = *state_;
  const ScanId scan = s.scans.add(step);
  s.refinement.add_scan();
  s.refinement.continue_stretch();
  BackendUpdate update;
  if (!step.has_keyframe) {
    s.loops.search_elsewhere(s.T_local_keyframe(), s.graph.graph());
    s.compare_newest_scan(step);
    return update;
  }
  SWIFTLET_CHECK(s.chain.add(scan) == step.made.id, "no keyframe is left out");
  s.estimates.take(step.made);
  s.innovation.add(step.made.innovation, step.made.innovation_dof);
  s.graph.add_keyframe(step.made, s.T_local_keyframe());
  s.loops.add_keyframe(step.made, s.T_local_keyframe());
  s.graph.observe_building_axis(s.estimates);
  const bool was_unplaced = s.loops.unplaced_since().has_value();
  const std::uint64_t dropped_before = s.loops.counters().closures_dropped;
  update.new_closures = s.loops.close_loops(s.T_local_keyframe(), s.graph);
  s.loops.search_elsewhere(s.T_local_keyframe(), s.graph.graph());
  update.poses_changed = s.follow_graph(s.graph.settle());
  if (s.refine_stretch(update)) update.poses_changed = true;
  update.refined = s.refine_window(update);
  if (was_unplaced && !s.loops.unplaced_since()) s.agreement.begin_again();
  s.correct_newest(step.T_local_body);
  s.compare_newest_scan(step);
  if (s.doubt_motion_if_contradicted()) {
    update.poses_changed = true;
    s.correct_newest(step.T_local_body);
  }
  const bool has_dropped = s.loops.counters().closures_dropped > dropped_before;
  if (update.new_closures > 0 || has_dropped || step.made.starts_segment) s.confidence.reset();
  return update;
}

BackendUpdate Backend::finish(const MapAgain& map_again) {
  State& s = *state_;
  BackendUpdate update;
  if (!s.loops.closures().empty() || !s.graph.graph().headings.empty()) {
    update.poses_changed = s.follow_graph(s.graph.optimize());
    while (s.graph.release_bent_motion() && s.follow_graph(s.graph.optimize())) {
    }
    while (s.loops.drop_worst(s.graph) && s.follow_graph(s.graph.optimize())) {
    }
  }
  if (s.refinement.refine_all(s.graph.graph(), s.T_local_keyframe(), map_again)) {
    update.poses_changed = true;
    ++s.version;
    s.drop_closures_off_map();
  }
  if (s.chain.size() > 0) s.correct_newest(s.T_local_keyframe().values().back());
  return update;
}

bool Backend::can_be_mapped_again() const {
  return state_->refinement.is_wanted() && state_->config.map_again && state_->scans_pruned == 0;
}

Pruning Backend::next_pruning() {
  State& s = *state_;
  const KeyframeId first_in_use = s.loops.open_since().value_or(s.chain.all().end_id());
  return s.pruner.next(s.T_map_keyframe(), first_in_use, s.loops.weighs_places());
}

void Backend::prune(const Pruning& pruning) {
  State& s = *state_;
  if (pruning.empty()) return;
  SWIFTLET_CHECK(!s.refinement.is_final(), "the run goes on");
  s.graph.erase(pruning.keyframes, ties_around(pruning, s.scans, s.graph.graph(), s.config.tuning));
  s.loops.erase(pruning.keyframes);
  s.estimates.erase(pruning.keyframes);
  s.pruner.keep_anchors(pruning);
  s.scans.erase(pruning.scans);
  s.chain.erase(pruning.keyframes);
  s.refinement.erase(pruning.scans, pruning.ids);
  s.scans_pruned += pruning.scan_count;
}

const ScanStore& Backend::scans() const { return state_->scans; }
const KeyframeChain& Backend::keyframes() const { return state_->chain; }
Pose2 Backend::T_map_keyframe(KeyframeId id) const { return T_map_body(state_->chain.scan_of(id)); }
Pose2 Backend::T_map_body(ScanId scan) const {
  return state_->refinement.T_map_body(scan, state_->T_map_keyframe());
}
MapCorrection Backend::correction() const { return state_->correction; }

TrackingFigures Backend::tracking() const {
  const State& s = *state_;
  if (s.chain.size() == 0) return {};
  const double here_m = s.chain.path_m(s.chain.all().last_id());
  const auto since_m = [&](KeyframeId id) { return here_m - s.chain.path_m(id); };
  const std::span<const LoopClosure> closures = s.loops.closures().values();
  const auto holds = [](const LoopClosure& closure) { return !closure.dropped; };
  const auto newest = std::find_if(closures.rbegin(), closures.rend(), holds);
  const std::optional<KeyframeId> unplaced = s.loops.unplaced_since();
  const bool weighs = s.loops.weighs_places();
  return {.tracking = s.tracking(),
          .contradiction = s.agreement.contradiction(),
          .contradicting_share = s.agreement.contradicting_share(),
          .returns_compared = s.agreement.returns_compared(),
          .times_uncertain = s.agreement.times_contradicted(),
          .places_weighed = weighs ? static_cast<std::uint32_t>(s.loops.places_weighed()) : 0U,
          .place_lead = weighs ? s.loops.place_lead() : 0.0,
          .innovation = s.innovation.per_degree(),
          .way_since_agreement_m = s.scans.all().values().back().path_m - s.agreement.agreed_at_m(),
          .way_since_closure_m = newest == closures.rend() ? here_m : since_m(newest->to),
          .way_unplaced_m = unplaced ? since_m(s.chain.all().at_or_after(*unplaced)) : 0.0};
}

std::optional<ScanId> Backend::doubted_since() const {
  const State& s = *state_;
  if (!s.config.close_loops) return std::nullopt;
  if (const std::optional<KeyframeId> unsure = s.unsure_since())
    return s.chain.scan_of(s.chain.all().at_or_after(*unsure));
  if (!s.agreement.is_contradicted()) return std::nullopt;
  return s.scans.all().at_or_after(s.agreement.agreed_last() + 1);
}

PoseConfidence Backend::confidence() {
  State& s = *state_;
  const Pose2& T_local_newest = s.T_local_keyframe().values().back();
  const double here_m = s.chain.path_m(s.chain.all().last_id());
  if (!s.confidence || here_m - s.confidence_at_m > s.config.tuning.confidence.recompute_after_m) {
    s.confidence = s.computed_confidence();
    s.confidence_at_m = here_m;
  }
  PoseConfidence newest = *s.confidence;
  newest.from_start = carried_on(s.confidence->from_start, *s.confidence, T_local_newest);
  newest.from_surroundings = carried_on(s.confidence->from_surroundings, *s.confidence, T_local_newest);
  newest.keyframe = s.correction.keyframe;
  newest.T_local_keyframe = T_local_newest;
  newest.yaw_map_local_rad = s.correction.T_map_local.yaw_rad();
  newest.has_older_map = !s.loops.submaps().empty();
  newest.figures = tracking();
  return newest;
}
const IdMap<ClosureId, LoopClosure>& Backend::closures() const { return state_->loops.closures(); }
const std::vector<Wall>& Backend::walls() const { return state_->estimates.walls(); }
const PoseGraph& Backend::pose_graph() const { return state_->graph.graph(); }

BackendCounters Backend::counters() const {
  const State& s = *state_;
  const RefinementCounters refinement = s.refinement.counters();
  return {.scans = index_of(s.scans.all().end_id()),
          .scans_pruned = s.scans_pruned,
          .keyframes = index_of(s.chain.all().end_id()),
          .submaps = s.loops.counters().submaps,
          .candidates_matched = s.loops.counters().candidates_matched,
          .closures_accepted = index_of(s.loops.closures().end_id()),
          .closures_dropped = s.loops.counters().closures_dropped,
          .optimizations = s.graph.counters().optimizations,
          .solver_failures = s.graph.counters().solver_failures + refinement.solver_failures,
          .windows_refined = refinement.windows_refined,
          .windows_refused = refinement.windows_refused,
          .stretches_refined = refinement.stretches_refined,
          .stretches_refused = refinement.stretches_refused,
          .refined = refinement.refined,
          .held_out_before_m = refinement.held_out_before_m,
          .held_out_after_m = refinement.held_out_after_m,
          .map_source = refinement.map_source,
          .yaw_noise_factor = refinement.yaw_noise_factor,
          .floor_cost = refinement.floor_cost,
          .misfit = refinement.misfit};
}

}  // namespace swiftlet

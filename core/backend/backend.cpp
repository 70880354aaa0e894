// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/backend.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "core/backend/backend_state.hpp"
#include "core/backend/pose_graph/relative_uncertainty.hpp"
#include "core/backend/refinement/batch_refinement.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kKeyframesOfCorrection = 4;  // about 2 m

// While flying, news that the graph had expected waits for others ...
constexpr double kExpectedChiSquare = 1.0;
constexpr std::uint32_t kMaxKeyframesWaiting = 8;
// ... and solutions need not be as fine, nor to be ends of a long way: the next keyframe goes on.
constexpr double kLiveStep = 1e-3;
constexpr OptimizeEffort kLiveEffort{kLiveStep, 4};
constexpr OptimizeEffort kTrialEffort{kLiveStep, 10};
// Of a group, chi-square a closure: half of the three that a closure's degrees of freedom would allow, for
// the matches' covariances are wide.
constexpr double kMaxMisfit = 1.5;

RelativePoseFactor<KeyframeId> factor_of(const LoopClosure& closure) {
  return {closure.from, closure.to, closure.T_from_to,
          residual_information(closure.T_from_to, closure.covariance.matrix()), true};
}

/// Chi-square a closure.
double misfit(const std::vector<LoopClosure>& group, const KeyframePoses& T_map_keyframe) {
  double sum = 0.0;
  for (const LoopClosure& closure : group) sum += chi_square(factor_of(closure), T_map_keyframe);
  return sum / static_cast<double>(group.size());
}

}  // namespace

/// State copying (eq. 20): the frontend's window holds its latest estimates of its keyframes.
void Backend::State::take_estimates(const Keyframe& made) {
  const std::size_t count = made.T_local_keyframe.size();
  SWIFTLET_CHECK(count >= 1 && count <= T_local_keyframe.size() + 1, "the window ends with the new keyframe");
  T_local_keyframe.push_back({});
  KeyframeId id = made.id - static_cast<std::uint32_t>(count - 1);
  for (const Pose2& T_local : made.T_local_keyframe) {
    T_local_keyframe[id] = T_local;
    if (id > T_local_keyframe.first_id() && id < made.id && motion_factor[id])
      graph.factors[*motion_factor[id]].T_from_to = between(T_local_keyframe[id - 1], T_local);
    ++id;
  }
}

void Backend::State::add_motion(const Keyframe& made) {
  graph.T_map_keyframe.push_back(T_local_keyframe[made.id]);
  motion_factor.push_back({});
  if (made.id == T_local_keyframe.first_id()) return;
  RelativePoseFactor<KeyframeId> step;
  step.from = T_local_keyframe.previous(made.id);
  step.to = made.id;
  step.T_from_to = between(T_local_keyframe[step.from], T_local_keyframe[step.to]);
  step.information = made.starts_segment && !made.odometry_ran_on
                         ? unknown_motion_information()
                         : residual_information(step.T_from_to, made.motion_covariance.matrix());
  motion_factor[made.id] = graph.factors.push_back(step);
}

void Backend::State::carry_new_poses() {
  KeyframePoses& T_map = graph.T_map_keyframe;
  for (KeyframeId k = T_map.next(optimized_upto); k < T_map.end_id(); k = T_map.next(k))
    T_map[k] = T_map[T_map.previous(k)] * motion_to(k).T_from_to;
}

void Backend::State::take_walls(const Keyframe& made) {
  for (const LandmarkUpdate& update : made.landmarks) {
    const Wall wall{update.id, made.id, update.start_keyframe, update.end_keyframe};
    const auto at = std::lower_bound(walls.begin(), walls.end(), update.id,
                                     [](const Wall& w, LandmarkId id) { return w.id < id; });
    if (at != walls.end() && at->id == update.id) {
      *at = wall;
    } else {
      walls.insert(at, wall);
    }
  }
}

/// Submaps overlap by half, so that no place lies only on a seam.
void Backend::State::finish_submaps(KeyframeId newest) {
  const double here_m = chain.path_m(newest);
  if (open_submaps.empty() || here_m - chain.path_m(open_submaps.back()) >= 0.5 * config.submap_length_m) {
    open_submaps.push_back(newest);
  }
  while (here_m - chain.path_m(open_submaps.front()) >= config.submap_length_m) {
    submaps.push_back(std::make_shared<const Submap>(
        build_submap(open_submaps.front(), newest, scans, chain, T_local_keyframe, config)));
    ++counters.submaps;
    open_submaps.erase(open_submaps.begin());
  }
}

/// How uncertain the heading has become from one keyframe to a later one by motion alone, or where that lost
/// it, as a closure may since have told.
double Backend::State::yaw_variance_rad2(KeyframeId from, KeyframeId to) const {
  constexpr double kLostRad2 = radians(15) * radians(15);
  double variance_rad2 = 0.0;
  for (KeyframeId k = from; k != to;) {
    k = motion_factor.next(k);
    variance_rad2 += motion_to(k).information.inverse()(2, 2);
  }
  return variance_rad2 < kLostRad2 ? variance_rad2 : relative_covariances(graph, from)[to](2, 2);
}

/// Once in every few metres, by the walls around.
bool Backend::State::hold_heading(KeyframeId newest) {
  const double here_m = chain.path_m(newest);
  if (!config.align_to_walls || here_m - chain.path_m(heading_sought_at) < 0.5 * config.submap_length_m)
    return false;
  heading_sought_at = newest;
  std::vector<WallDirection> around;
  for (const Wall& wall : walls) {
    if (wall.anchor < motion_known_since || here_m - chain.path_m(wall.anchor) > config.submap_length_m)
      continue;
    const double dx_m = wall.end_keyframe.x_m - wall.start_keyframe.x_m;
    const double dy_m = wall.end_keyframe.y_m - wall.start_keyframe.y_m;
    const double turned_rad = T_local_keyframe[wall.anchor].yaw_rad() - T_local_keyframe[newest].yaw_rad();
    around.push_back({std::atan2(dy_m, dx_m) + turned_rad, std::hypot(dx_m, dy_m)});
  }
  const std::optional<WallAxis> axis = wall_axis(around);
  if (!axis) return false;
  const std::size_t before = graph.headings.size();
  building_axis_prior.add(newest, *axis,
                          before == 0 ? 0.0 : yaw_variance_rad2(graph.headings.back().pose, newest), graph);
  return graph.headings.size() > before;
}

std::uint32_t Backend::State::close_loops(KeyframeId newest) {
  const std::size_t earlier = chain.all().position(newest);
  if (!config.close_loops || earlier % static_cast<std::size_t>(config.match_every_keyframes) != 0) return 0;
  const std::size_t before = closures.size();
  const FoundLoops found =
      detector.find(newest, submaps, graph, T_local_keyframe, counters.candidates_matched);
  for (const LoopClosure& closure : found.sure) add_closure(closure);
  if (!found.maybe.empty()) believe(groups.add(found.maybe, graph));
  return static_cast<std::uint32_t>(closures.size() - before);
}

void Backend::State::add_closure(LoopClosure closure) {
  ++counters.closures_accepted;
  closure.id = closures.end_id();
  closure.factor = graph.factors.push_back(factor_of(closure));
  closures.push_back(closure);
}

/// A group that the map had expected needs no more. Another may lie farther off than DCS lets a closure pull:
/// the map goes there first, or the group is refused.
void Backend::State::believe(const std::vector<LoopClosure>& group) {
  if (group.empty()) return;
  if (misfit(group, graph.T_map_keyframe) > kMaxMisfit && !move_map_to(group)) return;
  for (const LoopClosure& closure : group) add_closure(closure);
}

/// False: the group does not hold together there, against what else is known, and the map stays.
bool Backend::State::move_map_to(const std::vector<LoopClosure>& group) {
  building_axis_prior.update(graph);
  PoseGraph trial = graph;
  for (const LoopClosure& closure : group) {
    RelativePoseFactor<KeyframeId> factor = factor_of(closure);
    factor.is_closure = false;
    trial.factors.push_back(factor);
  }
  if (!optimizer.optimize(trial, kTrialEffort)) {
    ++counters.solver_failures;
    return false;
  }
  if (misfit(group, trial.T_map_keyframe) > kMaxMisfit) return false;
  graph.T_map_keyframe = std::move(trial.T_map_keyframe);
  group_moved_map = true;
  return true;
}

/// Whether the last solution is still on its way, what is new disagrees with the graph, or something that
/// does not has waited long enough.
bool Backend::State::is_due(bool turned, std::uint32_t new_closures, KeyframeId newest) {
  news_waits |= turned || new_closures > 0;
  if (group_moved_map || unsettled) return true;
  if (!news_waits) return false;
  if (newest - optimized_upto >= kMaxKeyframesWaiting) return true;
  if (turned) {
    building_axis_prior.update(graph);
    if (chi_square(graph.headings.back(), graph.T_map_keyframe) > kExpectedChiSquare) return true;
  }
  const std::span<const LoopClosure> all = closures.values();
  return std::any_of(all.end() - new_closures, all.end(), [&](const LoopClosure& closure) {
    return chi_square(graph.factors[closure.factor], graph.T_map_keyframe) > kExpectedChiSquare;
  });
}

bool Backend::State::optimize(const OptimizeEffort& effort) {
  ++counters.optimizations;
  news_waits = false;
  const bool has_moved = std::exchange(group_moved_map, false);
  building_axis_prior.update(graph);
  const Result<OptimizeReport> report = optimizer.optimize(graph, effort);
  unsettled = report && !report->converged;
  if (!report) {
    ++counters.solver_failures;
    version += has_moved ? 1 : 0;
    return has_moved;
  }
  for (LoopClosure& closure : closures.values())
    if (!closure.dropped) closure.dcs_scale = graph.factors[closure.factor].dcs_scale;
  optimized_upto = graph.T_map_keyframe.last_id();
  ++version;
  return true;
}

/// Takes out what DCS has scaled away, the least believed first, and lets the rest settle again.
bool Backend::State::drop_false_closures() {
  LoopClosure* worst = nullptr;
  for (LoopClosure& closure : closures.values()) {
    if (closure.dropped || closure.dcs_scale >= config.drop_scale) continue;
    if (worst == nullptr || closure.dcs_scale < worst->dcs_scale) worst = &closure;
  }
  if (worst == nullptr) return false;
  worst->dropped = true;
  ++counters.closures_dropped;
  graph.factors[worst->factor].information.setZero();
  return optimize();
}

/// Gives every scan a pose of its own; keyframes take those of their scans.
bool Backend::State::refine() {
  if (!refines() || scans.size() < 2) return false;
  std::vector<Pose2> T_map_body =
      chain.T_w_bodies({scans.all().first_id(), scans.all().end_id()}, graph.T_map_keyframe);
  std::vector<RelativePoseFactor<ScanId>> believed;
  for (const RelativePoseFactor<KeyframeId>& f : graph.factors.values()) {
    if (!f.is_closure || f.information.isZero(0.0)) continue;
    believed.push_back(f.joining(chain.scan_of(f.from), chain.scan_of(f.to)));
    believed.back().information *= f.dcs_scale * f.dcs_scale;
  }
  std::vector<HeadingFactor<ScanId>> headings;
  for (const HeadingFactor<KeyframeId>& f : graph.headings) {
    headings.push_back(f.of(chain.scan_of(f.pose)));
    headings.back().information *= f.dcs_scale * f.dcs_scale;
  }
  const Result<RefinementReport> report =
      refine_scan_poses(scans, sensor, believed, headings, config, T_map_body);
  if (!report) {
    ++counters.solver_failures;
    return false;
  }
  counters.held_out_before_m = report->held_out_before_m;
  counters.held_out_after_m = report->held_out_after_m;
  counters.refined = report->accepted;
  if (!report->accepted) return false;
  T_map_refined = scans.all().with(std::move(T_map_body));
  for (const auto& [keyframe, scan] : chain.all()) graph.T_map_keyframe[keyframe] = T_map_refined[scan];
  ++version;
  return true;
}

/// One step of refinement, around the newest keyframe or elsewhere. Says in `update` what has moved.
void Backend::State::refine_online(BackendUpdate& update) {
  if (!refines()) return;
  if (update.poses_changed) live.follow(graph.T_map_keyframe);
  for (const LoopClosure& closure : closures.values().last(update.new_closures))
    live.queue_around(closure.from);
  const Result<ScanRange> refined = live.step(graph.T_map_keyframe, T_local_keyframe);
  counters.windows_refined = live.windows_refined();
  counters.windows_refused = live.windows_refused();
  if (!refined) {
    ++counters.solver_failures;
    return;
  }
  update.refined = *refined;
  if (!update.refined.empty()) ++version;
}

/// Where the newest keyframe lies as the last few see it, the frontend's path from them to it being good to
/// a centimetre: each was refined by itself, and the vehicle is not to jump with every one.
Pose2 Backend::State::T_map_newest() const {
  const Pose2 T_map_tip = T_map_body(chain.all().values().back());
  if (!refines() || !T_map_refined.empty()) return T_map_tip;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // of differences from the tip
  std::size_t count = 0;
  const std::span<const Pose2> T_local = std::as_const(T_local_keyframe).values();
  for (std::size_t k = T_local.size(); k-- > 0 && count < kKeyframesOfCorrection;) {
    const ScanId scan = chain.all().values()[k];
    const Pose2 T_map_seen = T_map_body(scan) * between(T_local[k], T_local.back());
    sum += Eigen::Vector3d(T_map_seen.x_m() - T_map_tip.x_m(), T_map_seen.y_m() - T_map_tip.y_m(),
                           wrap_angle(T_map_seen.yaw_rad() - T_map_tip.yaw_rad()));
    ++count;
    if (scans[scan].starts_segment) break;
  }
  const Eigen::Vector3d mean = sum / static_cast<double>(count);
  return {T_map_tip.x_m() + mean(0), T_map_tip.y_m() + mean(1), T_map_tip.yaw_rad() + mean(2)};
}

Pose2 Backend::State::T_map_body(ScanId scan) const {
  if (!T_map_refined.empty()) return T_map_refined[scan];
  return live.refined(scan, chain.T_w_body(scan, graph.T_map_keyframe));
}

Backend::Backend(const BackendConfig& config, const SensorModel& sensor, const BeamLayout& beams) {
  SWIFTLET_CHECK(config.validate().empty(), "the backend's configuration is valid");
  state_ = std::make_unique<State>(config, sensor, beams);
}
Backend::~Backend() = default;

BackendUpdate Backend::add(const FrontendStep& step) {
  State& s = *state_;
  const ScanId scan = s.scans.add(step);
  s.live.add_scan();
  ++s.counters.scans;
  BackendUpdate update;
  if (!step.has_keyframe) return update;
  const Keyframe& made = step.made;
  SWIFTLET_CHECK(s.chain.add(scan) == made.id, "no keyframe is left out");
  ++s.counters.keyframes;
  s.take_estimates(made);
  s.add_motion(made);
  s.carry_new_poses();
  s.take_walls(made);
  if (made.starts_segment) s.open_submaps.clear();  // a submap is one stretch of known motion
  if (made.starts_segment && !made.odometry_ran_on) s.motion_known_since = made.id;
  s.finish_submaps(made.id);
  const bool turned = s.hold_heading(made.id);
  update.new_closures = s.close_loops(made.id);
  update.poses_changed = s.is_due(turned, update.new_closures, made.id) && s.optimize(kLiveEffort);
  s.refine_online(update);
  return update;
}

BackendUpdate Backend::finish() {
  BackendUpdate update;
  if (!state_->closures.empty() || !state_->graph.headings.empty()) {
    update.poses_changed = state_->optimize();
    while (state_->drop_false_closures()) {
    }
  }
  if (state_->refine()) update.poses_changed = true;
  return update;
}

const ScanStore& Backend::scans() const { return state_->scans; }
const KeyframeChain& Backend::keyframes() const { return state_->chain; }
Pose2 Backend::T_map_keyframe(KeyframeId id) const { return state_->T_map_body(state_->chain.scan_of(id)); }
Pose2 Backend::T_map_body(ScanId scan) const { return state_->T_map_body(scan); }
MapCorrection Backend::correction() const {
  const State& s = *state_;
  if (s.T_local_keyframe.empty()) return {};
  return {s.chain.all().last_id(), s.T_map_newest() * s.T_local_keyframe.values().back().inverse(),
          s.version};
}
const IdMap<ClosureId, LoopClosure>& Backend::closures() const { return state_->closures; }
const std::vector<Wall>& Backend::walls() const { return state_->walls; }
const BackendCounters& Backend::counters() const { return state_->counters; }

}  // namespace swiftlet

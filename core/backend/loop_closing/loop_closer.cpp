// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/loop_closer.hpp"

#include <algorithm>
#include <utility>

#include "core/geometry/pose_residual.hpp"

namespace swiftlet {
namespace {

/// For so long a vehicle may have been moved while its estimate ran on. Longer, and the twin of where it
/// stands wins more often than a room that it was carried to.
constexpr Duration kUnnoticed = std::chrono::seconds(2);

RelativePoseFactor<KeyframeId> factor_of(const LoopClosure& closure) {
  return {closure.from, closure.to, closure.T_from_to,
          residual_information(closure.T_from_to, closure.covariance.matrix()), true};
}

std::vector<RelativePoseFactor<KeyframeId>> factors_of(std::span<const LoopClosure> closures) {
  std::vector<RelativePoseFactor<KeyframeId>> factors;
  for (const LoopClosure& closure : closures) factors.push_back(factor_of(closure));
  return factors;
}

}  // namespace

LoopCloser::LoopCloser(const BackendConfig& config, const ScanStore& scans, const KeyframeChain& chain)
    : config_(&config),
      scans_(&scans),
      chain_(&chain),
      detector_(config, scans, chain),
      elsewhere_(config, scans, chain),
      places_(config, scans, chain) {}

/// Each submap is one stretch of known motion on one storey.
void LoopCloser::add_keyframe(const Keyframe& made, const KeyframePoses& T_local_keyframe) {
  if (made.id != chain_->all().first_id() &&
      chain_->storey(made.id) != chain_->storey(chain_->all().previous(made.id)))
    finish_open(made.id, T_local_keyframe);
  if (made.starts_segment) {
    const bool has_map = !submaps_.empty();  // else there is none to place it in
    if (has_map) finish_open(made.id, T_local_keyframe);
    open_submaps_.clear();
    if (has_map) begin_break(made);
  }
  const double here_m = chain_->path_m(made.id);
  if (open_submaps_.empty() || here_m - chain_->path_m(open_submaps_.back()) >=
                                   config_->tuning.submap.start_share * config_->submap_length_m)
    open_submaps_.push_back(made.id);
  while (here_m - chain_->path_m(open_submaps_.front()) >= config_->submap_length_m) {
    finish_oldest(made.id, T_local_keyframe);
    open_submaps_.erase(open_submaps_.begin());
  }
}

/// A restart or a doubt that no place has ended goes on across a silence, and a restart across the next one,
/// also if its place was not beyond doubt: what was flown in between is no older map, and says nothing of
/// where in that the vehicle is. Across a silence places are weighed on.
void LoopCloser::begin_break(const Keyframe& made) {
  unjoined_since_ = made.id;
  if (provisional_ && made.odometry_ran_on) return;
  if (provisional_) unplaced_since_ = provisional_->since;
  forget_places();
  const bool is_open = unplaced_since_ && unplaced_by_ != UnplacedBy::kSilence;
  if (is_open && made.odometry_ran_on) return;
  if (!is_open || unplaced_by_ == UnplacedBy::kContradiction) unplaced_since_ = made.id;
  unplaced_by_ = made.odometry_ran_on ? UnplacedBy::kSilence : UnplacedBy::kRestart;
  MotionBreak motion_break;
  motion_break.estimate_ran_on = made.odometry_ran_on;
  if (!made.odometry_ran_on) {
    const ScanId before =
        scans_->all().previous(chain_->scan_of(chain_->all().at_or_after(*unplaced_since_)));
    motion_break.unwatched = (*scans_)[chain_->scan_of(made.id)].stamp - (*scans_)[before].stamp;
  }
  places_.begin(motion_break);
}

/// Of the open submaps, up to the keyframe before `end`.
void LoopCloser::finish_oldest(KeyframeId end, const KeyframePoses& T_local_keyframe) {
  submaps_.push_back(std::make_shared<const Submap>(
      build_submap(open_submaps_.front(), end, *scans_, *chain_, T_local_keyframe, *config_)));
  ++counters_.submaps;
}

/// The newest ground is known, though its submap is short: to who comes back to a storey; and behind a break,
/// where it tells whether the vehicle stands where it stood.
void LoopCloser::finish_open(KeyframeId end, const KeyframePoses& T_local_keyframe) {
  if (!open_submaps_.empty()) finish_oldest(end, T_local_keyframe);
  open_submaps_.clear();
}

void LoopCloser::doubt_since(KeyframeId keyframe, double log_odds) {
  open_submaps_.clear();
  unplaced_by_ = UnplacedBy::kContradiction;
  if (resume_doubt()) return;
  unplaced_since_ = keyframe;
  forget_places();
  places_.begin({kUnnoticed, chain_->all().previous(keyframe), log_odds, false});
}

void LoopCloser::end_doubt() {
  if (!unplaced_since_ || unplaced_by_ != UnplacedBy::kContradiction) return;
  if (unjoined_since_) {
    search_across_silence();
  } else {
    suspend_doubt();
  }
}

/// What it left open when a doubt came between, or a place that was not beyond doubt.
void LoopCloser::search_across_silence() {
  forget_places();
  unplaced_since_ = unjoined_since_;
  unplaced_by_ = UnplacedBy::kSilence;
  MotionBreak silence;
  silence.estimate_ran_on = true;
  places_.begin(silence);
}

/// A correction or some scans that agree end the contradiction, and what was learnt of the places with it. If
/// the motion was at fault, it comes back soon.
void LoopCloser::suspend_doubt() {
  suspended_since_ = std::exchange(unplaced_since_, std::nullopt);
  suspended_at_m_ = chain_->path_m(chain_->all().last_id());
  stop_searching();
}

/// Before ground flown since the doubt ended counts as older map itself.
bool LoopCloser::resume_doubt() {
  const double since_m = chain_->path_m(chain_->all().last_id()) - suspended_at_m_;
  if (!suspended_since_ || since_m > config_->tuning.confidence.old_after_m) return false;
  unplaced_since_ = std::exchange(suspended_since_, std::nullopt);
  places_.resume();
  return true;
}

/// From where on a match with what lies before proves something alone. Of a contradiction nobody knows that
/// the motion is at fault.
KeyframeId LoopCloser::watched_since() const { return unjoined_since_.value_or(chain_->all().first_id()); }

/// Where the travel begins that a place moves as a whole. In doubt nobody knows at which keyframe the motion
/// went wrong: none is moved so.
KeyframeId LoopCloser::travel_since() const {
  return unplaced_by_ == UnplacedBy::kContradiction ? chain_->all().end_id() : *unjoined_since_;
}

std::uint32_t LoopCloser::close_loops(const KeyframePoses& T_local_keyframe, KeyframeGraph& graph) {
  const std::size_t earlier = chain_->size() - 1;
  if (!config_->close_loops || earlier % static_cast<std::size_t>(config_->match_every_keyframes) != 0)
    return 0;
  const std::size_t before = closures_.size();
  const FoundLoops found = detector_.find(chain_->all().last_id(), watched_since(), submaps_, graph.graph(),
                                          T_local_keyframe, counters_.candidates_matched);
  for (const LoopClosure& closure : found.confirmed) accept(closure, graph);
  if (unplaced_since_) {
    place_travel(found.tentative, T_local_keyframe, graph);
  } else if (provisional_) {
    weigh_on(T_local_keyframe, graph);
  }
  return static_cast<std::uint32_t>(closures_.size() - before);
}

void LoopCloser::search_elsewhere(const KeyframePoses& T_local_keyframe, const PoseGraph& graph) {
  if (!unplaced_since_) return;
  if (!proposed_.empty()) {
    places_.propose(proposed_.back(), submaps_before(*unplaced_since_), graph,
                    path_of_travel(T_local_keyframe, graph));
    proposed_.pop_back();
  } else if (elsewhere_.is_busy()) {
    elsewhere_.step();
    ++counters_.candidates_matched;
  }
}

std::span<const std::shared_ptr<const Submap>> LoopCloser::submaps_before(KeyframeId since) const {
  const auto end =
      std::ranges::partition_point(submaps_, [&](const auto& s) { return s->reference < since; });
  return std::span(submaps_).first(static_cast<std::size_t>(end - submaps_.begin()));
}

/// Up to the newest keyframe; nothing before there is a motion to it.
std::optional<ScanRange> LoopCloser::recent_scans() const {
  const KeyframeId newest = chain_->all().last_id();
  const ScanRange recent = detector_.recent_scans(newest);
  if (chain_->scan_of(chain_->all().previous(newest)) < recent.first) return std::nullopt;
  return recent;
}

/// Behind a break no closure joins the travel to what lies before: the graph has what was learnt of the
/// travel alone. In doubt closures go on moving it, and only the frontend's path is free of them.
const KeyframePoses& LoopCloser::path_of_travel(const KeyframePoses& T_local_keyframe,
                                                const PoseGraph& graph) const {
  return unplaced_by_ == UnplacedBy::kContradiction ? T_local_keyframe : graph.T_map_keyframe;
}

/// Weighs where the travel since it was last watched may lie.
void LoopCloser::place_travel(std::span<const LoopClosure> matches, const KeyframePoses& T_local_keyframe,
                              KeyframeGraph& graph) {
  const KeyframeId newest = chain_->all().last_id();
  const std::optional<ScanRange> recent = recent_scans();
  if (!recent) return;
  const auto earlier = submaps_before(*unplaced_since_);
  const KeyframePoses& path = path_of_travel(T_local_keyframe, graph.graph());
  const bool is_new = places_.add_query(newest, *recent, earlier, graph.graph(), T_local_keyframe, path);
  for (const LoopClosure& match : matches)
    if (match.from < *unplaced_since_) proposed_.push_back(match);
  if (is_new)
    for (const LoopClosure& match : places_.turned(earlier, graph.graph(), path)) proposed_.push_back(match);
  if (!elsewhere_.is_busy()) {
    for (const LoopClosure& match : elsewhere_.take_found()) proposed_.push_back(match);
    if (is_new) elsewhere_.begin(newest, *recent, earlier, T_local_keyframe);
  }
  if (is_new) place_is_refused_ = false;
  if (!place_is_refused_) place_is_refused_ = !accept_place(places_.decided(), graph);
}

/// The room where the vehicle stood may have a twin on the map, and the ground around it be new: then the
/// twin gains all that is seen until beams meet its walls where the true ground is open.
void LoopCloser::weigh_on(const KeyframePoses& T_local_keyframe, KeyframeGraph& graph) {
  const KeyframeId newest = chain_->all().last_id();
  KeyframePoses& T_path = provisional_->T_path_keyframe;
  for (KeyframeId k = T_path.end_id(); k <= newest; ++k)
    T_path.push_back(T_path[k - 1] * between(T_local_keyframe[k - 1], T_local_keyframe[k]));
  const std::optional<ScanRange> recent = recent_scans();
  if (!recent || !places_.add_query(newest, *recent, submaps_before(provisional_->since), graph.graph(),
                                    T_local_keyframe, T_path))
    return;
  if (places_.is_beyond_doubt()) return unjoined_since_ ? search_across_silence() : forget_places();
  replace_place(places_.decided(), graph);
  if (places_.is_refuted()) withdraw_place(graph);
}

void LoopCloser::forget_places(const IdRanges<KeyframeId>& pruned) {
  suspended_since_.reset();
  provisional_.reset();
  places_.begin_again(pruned);
  stop_searching();
}

void LoopCloser::stop_searching() {
  elsewhere_.stop();
  proposed_.clear();
}

/// Those of a place that ends a doubt are older than what tracking closed meanwhile.
void LoopCloser::note_contact(KeyframeId query, const PoseGraph& graph) {
  const double here_m = chain_->path_m(query);
  if (!contact_ || here_m - contact_->newest_m > config_->tuning.confidence.old_after_m)
    contact_ = {query, graph.T_map_keyframe[query], here_m};
  if (query < contact_->since) contact_ = {query, graph.T_map_keyframe[query], contact_->newest_m};
  contact_->newest_m = std::max(contact_->newest_m, here_m);
}

std::optional<LoopCloser::Contact> LoopCloser::contact_that_moved(const PoseGraph& graph) const {
  if (!contact_) return std::nullopt;
  const ConfidenceTuning& tuning = config_->tuning.confidence;
  const double since_m = chain_->path_m(chain_->all().last_id()) - chain_->path_m(contact_->since);
  const Point2 is_map = graph.T_map_keyframe[contact_->since].position();
  const double moved_m = distance_m(contact_->T_map_since.position(), is_map);
  if (since_m > tuning.old_after_m || moved_m < tuning.tolerance_m) return std::nullopt;
  return contact_;
}

void LoopCloser::drop_contact(KeyframeGraph& graph) {
  if (!contact_) return;
  for (LoopClosure& closure : closures_.values())
    if (closure.to >= contact_->since && !closure.dropped) drop(closure, graph);
  contact_.reset();
}

void LoopCloser::drop(LoopClosure& closure, KeyframeGraph& graph) {
  closure.dropped = true;
  ++counters_.closures_dropped;
  graph.disable(closure.factor);
}

void LoopCloser::accept(LoopClosure closure, KeyframeGraph& graph) {
  note_contact(closure.to, graph.graph());
  closure.id = closures_.end_id();
  closure.factor = graph.add_closure(factor_of(closure));
  closures_.push_back(closure);
}

void LoopCloser::drop_closures_to_place(KeyframeGraph& graph) {
  for (LoopClosure& closure : closures_.values())
    if (closure.from < provisional_->since && closure.to >= provisional_->since && !closure.dropped)
      drop(closure, graph);
  contact_.reset();
}

/// The travel lies elsewhere, and none of the others is likely enough: the search begins anew.
void LoopCloser::withdraw_place(KeyframeGraph& graph) {
  drop_closures_to_place(graph);
  search_anew();
}

void LoopCloser::search_anew(const IdRanges<KeyframeId>& pruned) {
  unplaced_since_ = provisional_->since;
  if (!unjoined_since_) unjoined_since_ = provisional_->moved_since;
  forget_places(pruned);
}

/// All closures that joined the travel to the place before are dropped. Where the graph refuses, all stays.
/// A silence meanwhile is joined only by a match from behind it.
void LoopCloser::replace_place(std::span<const LoopClosure> decided, KeyframeGraph& graph) {
  if (decided.empty() || !graph.accommodate(factors_of(decided), provisional_->moved_since)) return;
  drop_closures_to_place(graph);
  if (unjoined_since_ && decided.back().to >= *unjoined_since_) unjoined_since_.reset();
  places_.accept_likeliest();
  for (const LoopClosure& closure : decided) accept(closure, graph);
}

/// False: it does not fit into the graph, which is as it was. The contact is with the map before it moved.
bool LoopCloser::accept_place(std::span<const LoopClosure> decided, KeyframeGraph& graph) {
  if (decided.empty()) return true;
  std::optional<Provisional> placed;
  if (unplaced_by_ == UnplacedBy::kRestart)
    placed = {*unplaced_since_, *unjoined_since_, graph.T_map_keyframe()};
  const std::optional<Contact> contact_before = contact_;
  // Travel does not tell how long ago the old contact was: it does not grow across a break.
  if (unplaced_by_ != UnplacedBy::kContradiction) contact_.reset();
  note_contact(decided.front().to, graph.graph());
  if (!graph.accommodate(factors_of(decided), travel_since())) {
    contact_ = contact_before;
    return false;
  }
  if (placed) {
    places_.accept_likeliest();
    stop_searching();
  } else {
    forget_places();
  }
  provisional_ = std::move(placed);
  unplaced_since_.reset();
  unjoined_since_.reset();
  for (const LoopClosure& closure : decided)
    if (!is_closed(closure)) accept(closure, graph);
  return true;
}

/// In doubt its matches were accepted as they were found, where tracking had them.
bool LoopCloser::is_closed(const LoopClosure& match) const {
  return std::ranges::any_of(closures_.values(), [&](const LoopClosure& closure) {
    return closure.from == match.from && closure.to == match.to && !closure.dropped;
  });
}

void LoopCloser::take_scales(const PoseGraph& graph) {
  for (LoopClosure& closure : closures_.values())
    if (!closure.dropped) closure.dcs_scale = graph.factors[closure.factor].dcs_scale;
}

bool LoopCloser::drop_worst(KeyframeGraph& graph) {
  LoopClosure* worst = nullptr;
  for (LoopClosure& closure : closures_.values()) {
    if (closure.dropped || closure.dcs_scale >= config_->drop_scale) continue;
    if (worst == nullptr || closure.dcs_scale < worst->dcs_scale) worst = &closure;
  }
  if (worst == nullptr) return false;
  drop(*worst, graph);
  return true;
}

void LoopCloser::drop_those_off(const KeyframePoses& T_map_keyframe, KeyframeGraph& graph) {
  for (LoopClosure& closure : closures_.values()) {
    if (closure.dropped) continue;
    closure.dcs_scale = dcs_scale(chi_square(factor_of(closure), T_map_keyframe), config_->dcs_phi);
    if (closure.dcs_scale < config_->drop_scale) drop(closure, graph);
  }
}

void LoopCloser::erase(const IdRanges<KeyframeId>& pruned) {
  std::erase_if(submaps_, [&](const auto& submap) { return pruned.contains(submap->reference); });
  closures_.erase_if([&](const LoopClosure& closure) {
    return pruned.contains(closure.from) || pruned.contains(closure.to);
  });
  if (contact_ && pruned.contains(contact_->since)) contact_.reset();
  if (provisional_) return search_anew(pruned);
  forget_places(pruned);
}

std::optional<KeyframeId> LoopCloser::provisional_since() const {
  if (!provisional_) return std::nullopt;
  return provisional_->since;
}

std::optional<KeyframeId> LoopCloser::open_since() const {
  if (open_submaps_.empty()) return std::nullopt;
  return open_submaps_.front();
}

}  // namespace swiftlet

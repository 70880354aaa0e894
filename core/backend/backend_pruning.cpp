// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <algorithm>
#include <limits>
#include <utility>

#include "core/backend/backend_state.hpp"

// How the backend forgets what others know as well: all that it holds is renumbered.
namespace swiftlet {
namespace {

constexpr double kPrunedShare = 0.05;  // of the most scans, at a time

constexpr std::size_t kGone = std::numeric_limits<std::size_t>::max();

KeyframeId moved(KeyframeId id, const IndexRemoval& keyframes) {
  return static_cast<KeyframeId>(keyframes.new_index(index_of(id)));
}

}  // namespace

/// What the frontend may still change, submaps will be built of, and walls are looked for in.
KeyframeId Backend::State::first_recent() const {
  std::size_t first = T_local_keyframe.size() - std::min(T_local_keyframe.size(), 2 * kMaxKeyframeWindow);
  const double recent_m = chain.path_m(static_cast<KeyframeId>(chain.size() - 1)) -
                          2.0 * std::max(config.submap_length_m, config.multiscan_length_m);
  while (first > 0 && chain.path_m(static_cast<KeyframeId>(first)) > recent_m) --first;
  if (!open_submaps.empty()) first = std::min<std::size_t>(first, index_of(open_submaps.front()));
  return static_cast<KeyframeId>(first);
}

/// Keeps those between keyframes that stay.
void Backend::State::remove_constraints(const IndexRemoval& keyframes) {
  std::vector<PoseConstraint> kept;
  std::vector<std::size_t> now_at(graph.constraints.size(), kGone);
  for (std::size_t i = 0; i < graph.constraints.size(); ++i) {
    PoseConstraint c = graph.constraints[i];
    if (keyframes.removes(index_of(c.from)) || keyframes.removes(index_of(c.to))) continue;
    c.from = moved(c.from, keyframes);
    c.to = moved(c.to, keyframes);
    now_at[i] = kept.size();
    kept.push_back(c);
  }
  graph.constraints = std::move(kept);
  remove_motions(keyframes, now_at);
  remove_closures(keyframes, now_at);
}

/// Across a hole the motion is unknown. `now_at`: where each constraint went.
void Backend::State::remove_motions(const IndexRemoval& keyframes, const std::vector<std::size_t>& now_at) {
  std::vector<std::size_t> kept;
  std::uint32_t previous = 0;
  for (std::uint32_t k = 1; k <= motion_constraint.size(); ++k) {
    if (keyframes.removes(k)) continue;
    if (previous + 1 == k) {
      kept.push_back(now_at[motion_constraint[k - 1]]);
    } else {
      PoseConstraint unknown;
      unknown.from = moved(static_cast<KeyframeId>(previous), keyframes);
      unknown.to = moved(static_cast<KeyframeId>(k), keyframes);
      unknown.T_from_to = between(graph.T_map_keyframe[previous], graph.T_map_keyframe[k]);
      unknown.information = unknown_motion_information();
      kept.push_back(graph.constraints.size());
      graph.constraints.push_back(unknown);
    }
    previous = k;
  }
  motion_constraint = std::move(kept);
}

void Backend::State::remove_closures(const IndexRemoval& keyframes, const std::vector<std::size_t>& now_at) {
  std::vector<LoopClosure> kept;
  std::vector<std::size_t> constraint_of_kept;
  for (std::size_t i = 0; i < closures.size(); ++i) {
    if (now_at[closure_constraint[i]] == kGone) continue;
    LoopClosure& closure = kept.emplace_back(closures[i]);
    closure.from = moved(closure.from, keyframes);
    closure.to = moved(closure.to, keyframes);
    constraint_of_kept.push_back(now_at[closure_constraint[i]]);
  }
  closures = std::move(kept);
  closure_constraint = std::move(constraint_of_kept);
}

/// A submap lives as long as the keyframe that is its frame.
void Backend::State::remove_submaps(const IndexRemoval& keyframes) {
  std::erase_if(submaps, [&](const auto& submap) { return keyframes.removes(index_of(submap->reference)); });
  for (std::shared_ptr<const Submap>& submap : submaps) {
    Submap renumbered = *submap;
    renumbered.reference = moved(submap->reference, keyframes);
    renumbered.first = moved(submap->first, keyframes);
    renumbered.last = moved(submap->last, keyframes);
    submap = std::make_shared<const Submap>(std::move(renumbered));
  }
}

void Backend::State::remove_walls(const IndexRemoval& keyframes) {
  std::erase_if(walls, [&](const Wall& wall) { return keyframes.removes(index_of(wall.anchor)); });
  for (Wall& wall : walls) wall.anchor = moved(wall.anchor, keyframes);
}

Pruning Backend::next_pruning() {
  State& s = *state_;
  if (s.scans.size() < s.prunes_at || s.chain.size() == 0) return {};
  const auto most = static_cast<std::size_t>(s.config.max_scans);
  const auto at_a_time = static_cast<std::size_t>(kPrunedShare * s.config.max_scans);
  Pruning pruning = plan_pruning(s.scans, s.chain, s.graph.T_map_keyframe, s.anchors, s.first_recent(),
                                 s.config.min_travel_between_m, s.scans.size() - most + at_a_time);
  // Where little can be spared, there is nothing to be gained by asking at every step.
  s.prunes_at = std::max(most, s.scans.size() - pruning.scans.size() + at_a_time);
  return pruning;
}

void Backend::prune(const Pruning& pruning) {
  State& s = *state_;
  if (pruning.empty()) return;
  SWIFTLET_CHECK(s.T_map_refined.empty(), "the run goes on");
  const IndexRemoval& keyframes = pruning.keyframes;
  const std::vector<PoseConstraint> ties = ties_around(pruning, s.scans, s.graph.T_map_keyframe);
  s.graph.constraints.insert(s.graph.constraints.end(), ties.begin(), ties.end());
  s.remove_constraints(keyframes);
  s.building_axis_prior.remove(keyframes, s.graph);
  s.remove_submaps(keyframes);
  s.remove_walls(keyframes);
  s.groups.clear();
  keyframes.apply(s.graph.T_map_keyframe);
  keyframes.apply(s.T_local_keyframe);
  keyframes.apply(s.frontend_ids);
  for (const PrunedTraversal& traversal : pruning.traversals) s.anchors.push_back(traversal.anchor);
  std::sort(s.anchors.begin(), s.anchors.end());
  s.anchors.erase(std::unique(s.anchors.begin(), s.anchors.end()), s.anchors.end());
  for (KeyframeId& anchor : s.anchors) anchor = moved(anchor, keyframes);
  s.optimized_upto = moved(s.optimized_upto, keyframes);
  s.heading_sought_at = moved(s.heading_sought_at, keyframes);
  s.motion_known_since = moved(s.motion_known_since, keyframes);
  for (KeyframeId& begin : s.open_submaps) begin = moved(begin, keyframes);
  s.scans.remove(pruning.scans, keyframes);
  s.chain.remove(pruning.scans, keyframes);
  s.live.remove(pruning.scans, keyframes);
  s.counters.scans_pruned += pruning.scans.size();
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include <algorithm>
#include <utility>

#include "core/backend/backend_state.hpp"
#include "core/backend/store/traversal.hpp"

// How the backend forgets what others know as well.
namespace swiftlet {
namespace {

constexpr double kPrunedShare = 0.05;  // of the most scans, at a time

/// Of whole traversals.
IdRanges<TraversalId> traversals_of(const Pruning& pruning) {
  IdRanges<TraversalId> traversals;
  for (const PrunedTraversal& traversal : pruning.traversals)
    traversals.add(traversal_of(traversal.keyframes.first));
  return traversals;
}

}  // namespace

/// What the frontend may still change, submaps will be built of, and walls are looked for in.
KeyframeId Backend::State::first_recent() const {
  const IdMap<KeyframeId, ScanId>& keyframes = chain.all();
  const double recent_m =
      chain.path_m(keyframes.last_id()) - 2.0 * std::max(config.submap_length_m, config.multiscan_length_m);
  std::size_t first = chain.size() - std::min(chain.size(), 2 * kMaxKeyframeWindow);
  while (first > 0 && chain.path_m(keyframes.id_at(first)) > recent_m) --first;
  const KeyframeId recent = keyframes.id_at(first);
  return open_submaps.empty() ? recent : std::min(recent, open_submaps.front());
}

/// Keeps those between keyframes that stay.
void Backend::State::erase_factors(const IdRanges<KeyframeId>& keyframes) {
  const auto goes = [&](const auto& joined) {
    return keyframes.contains(joined.from) || keyframes.contains(joined.to);
  };
  graph.factors.erase_if(goes);
  closures.erase_if(goes);
  motion_factor.erase(keyframes);
  graph.T_map_keyframe.erase(keyframes);
}

/// Across a hole the motion is unknown.
void Backend::State::join_across_holes() {
  const KeyframePoses& T_map = graph.T_map_keyframe;
  for (std::size_t k = 1; k < motion_factor.size(); ++k) {
    std::optional<FactorId>& joined = motion_factor.values()[k];
    if (graph.factors.contains(*joined)) continue;
    RelativePoseFactor<KeyframeId> unknown;
    unknown.from = T_map.id_at(k - 1);
    unknown.to = T_map.id_at(k);
    unknown.T_from_to = between(T_map[unknown.from], T_map[unknown.to]);
    unknown.information = unknown_motion_information();
    joined = graph.factors.push_back(unknown);
  }
}

Pruning Backend::next_pruning() {
  State& s = *state_;
  if (s.scans.size() < s.prunes_at || s.chain.size() == 0) return {};
  const auto most = static_cast<std::size_t>(s.config.max_scans);
  const auto at_a_time = static_cast<std::size_t>(kPrunedShare * s.config.max_scans);
  Pruning pruning = plan_pruning(s.scans, s.chain, s.graph.T_map_keyframe, s.anchors, s.first_recent(),
                                 s.config.min_travel_between_m, s.scans.size() - most + at_a_time);
  // Where little can be spared, there is nothing to be gained by asking at every step.
  s.prunes_at = std::max(most, s.scans.size() - pruning.scan_count + at_a_time);
  return pruning;
}

void Backend::prune(const Pruning& pruning) {
  State& s = *state_;
  if (pruning.empty()) return;
  SWIFTLET_CHECK(s.T_map_refined.empty(), "the run goes on");
  const IdRanges<KeyframeId>& keyframes = pruning.keyframes;
  for (const RelativePoseFactor<KeyframeId>& tie : ties_around(pruning, s.scans, s.graph.T_map_keyframe))
    s.graph.factors.push_back(tie);
  s.erase_factors(keyframes);
  s.join_across_holes();
  s.building_axis_prior.erase(keyframes, s.graph);
  // A submap lives as long as the keyframe that is its frame.
  std::erase_if(s.submaps, [&](const auto& submap) { return keyframes.contains(submap->reference); });
  std::erase_if(s.walls, [&](const Wall& wall) { return keyframes.contains(wall.anchor); });
  s.groups.clear();
  s.T_local_keyframe.erase(keyframes);
  for (const PrunedTraversal& traversal : pruning.traversals) s.anchors.push_back(traversal.anchor);
  std::sort(s.anchors.begin(), s.anchors.end());
  s.anchors.erase(std::unique(s.anchors.begin(), s.anchors.end()), s.anchors.end());
  s.scans.erase(pruning.scans);
  s.chain.erase(keyframes);
  s.optimized_upto = s.chain.all().at_or_after(s.optimized_upto);
  s.heading_sought_at = s.chain.all().at_or_after(s.heading_sought_at);
  s.live.erase(pruning.scans, traversals_of(pruning));
  s.counters.scans_pruned += pruning.scan_count;
}

}  // namespace swiftlet

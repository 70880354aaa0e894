// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/loop_closing/loop_closer.hpp"

#include <utility>

namespace swiftlet {
namespace {

RelativePoseFactor<KeyframeId> factor_of(const LoopClosure& closure) {
  return {closure.from, closure.to, closure.T_from_to,
          residual_information(closure.T_from_to, closure.covariance.matrix()), true};
}

}  // namespace

LoopCloser::LoopCloser(const BackendConfig& config, const ScanStore& scans, const KeyframeChain& chain)
    : config_(&config),
      scans_(&scans),
      chain_(&chain),
      detector_(config, scans, chain),
      groups_(chain, config.tuning) {}

/// Each submap is one stretch of known motion.
void LoopCloser::add_keyframe(const Keyframe& made, const KeyframePoses& T_local_keyframe) {
  if (made.starts_segment) open_submaps_.clear();
  const double here_m = chain_->path_m(made.id);
  if (open_submaps_.empty() || here_m - chain_->path_m(open_submaps_.back()) >=
                                   config_->tuning.submap.start_share * config_->submap_length_m)
    open_submaps_.push_back(made.id);
  while (here_m - chain_->path_m(open_submaps_.front()) >= config_->submap_length_m) {
    submaps_.push_back(std::make_shared<const Submap>(
        build_submap(open_submaps_.front(), made.id, *scans_, *chain_, T_local_keyframe, *config_)));
    ++counters_.submaps;
    open_submaps_.erase(open_submaps_.begin());
  }
}

std::uint32_t LoopCloser::close_loops(const KeyframePoses& T_local_keyframe, KeyframeGraph& graph) {
  const std::size_t earlier = chain_->size() - 1;
  if (!config_->close_loops || earlier % static_cast<std::size_t>(config_->match_every_keyframes) != 0)
    return 0;
  const std::size_t before = closures_.size();
  const FoundLoops found = detector_.find(chain_->all().last_id(), submaps_, graph.graph(), T_local_keyframe,
                                          counters_.candidates_matched);
  for (const LoopClosure& closure : found.confirmed) accept(closure, graph);
  if (!found.tentative.empty()) accept_group(groups_.add(found.tentative, graph.graph()), graph);
  return static_cast<std::uint32_t>(closures_.size() - before);
}

void LoopCloser::accept(LoopClosure closure, KeyframeGraph& graph) {
  closure.id = closures_.end_id();
  closure.factor = graph.add_closure(factor_of(closure));
  closures_.push_back(closure);
}

void LoopCloser::accept_group(std::span<const LoopClosure> group, KeyframeGraph& graph) {
  if (group.empty()) return;
  std::vector<RelativePoseFactor<KeyframeId>> factors;
  for (const LoopClosure& closure : group) factors.push_back(factor_of(closure));
  if (!graph.accommodate(factors)) return;
  for (const LoopClosure& closure : group) accept(closure, graph);
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
  worst->dropped = true;
  ++counters_.closures_dropped;
  graph.disable(worst->factor);
  return true;
}

void LoopCloser::erase(const IdRanges<KeyframeId>& pruned) {
  std::erase_if(submaps_, [&](const auto& submap) { return pruned.contains(submap->reference); });
  closures_.erase_if([&](const LoopClosure& closure) {
    return pruned.contains(closure.from) || pruned.contains(closure.to);
  });
  groups_.clear();
}

std::optional<KeyframeId> LoopCloser::open_since() const {
  if (open_submaps_.empty()) return std::nullopt;
  return open_submaps_.front();
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/backend/loop_closing/loop_closure.hpp"
#include "core/backend/loop_closing/submap.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/store/keyframe_chain.hpp"

namespace swiftlet {

/// What one query found.
struct FoundLoops {
  std::vector<LoopClosure> confirmed;
  std::vector<LoopClosure> tentative;  ///< too low a score for so wide a window, or with what lies before a
                                       ///< break: each alone proves nothing
};

/// Finds where the recent travel overlaps earlier submaps (Algorithm 3, lines 1-2).
class LoopDetector {
 public:
  /// Views all its arguments, which must outlive it.
  LoopDetector(const BackendConfig& config, const ScanStore& scans, const KeyframeChain& chain)
      : config_(&config), scans_(&scans), chain_(&chain) {}

  /// Matches the recent multiscan, as seen from keyframe `query`, against every submap it may overlap, given
  /// how well the graph knows where they are; where that is well enough, the newer part of it.
  /// `T_local_keyframe`: the frontend's estimates. `since`: from there to the query the motion was watched;
  /// what matches earlier submaps proves nothing alone. `tried` counts the submaps searched. Allocates.
  FoundLoops find(KeyframeId query, KeyframeId since, std::span<const std::shared_ptr<const Submap>> submaps,
                  const PoseGraph& graph, const KeyframePoses& T_local_keyframe, std::uint64_t& tried) const;

  /// The scans of the recent travel, as far as its motion was watched.
  [[nodiscard]] ScanRange recent_scans(KeyframeId query) const;

 private:
  struct Travel;
  struct Candidate;
  [[nodiscard]] ScanRange newest_scans(KeyframeId query, double length_m) const;
  [[nodiscard]] std::optional<Travel> newest_travel(KeyframeId query, double length_m,
                                                    const KeyframePoses& T_local_keyframe) const;
  [[nodiscard]] std::vector<Candidate> candidates(KeyframeId query, KeyframeId since, Travel& whole,
                                                  Travel& newer,
                                                  std::span<const std::shared_ptr<const Submap>> submaps,
                                                  const PoseGraph& graph) const;

  const BackendConfig* config_;
  const ScanStore* scans_;
  const KeyframeChain* chain_;
};

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <vector>

#include "core/backend/config/backend_config.hpp"
#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/store/keyframe_chain.hpp"
#include "core/backend/store/scan_store.hpp"
#include "core/base/ids.hpp"

namespace swiftlet {

/// A traversal over space that others cover as well, to be pruned.
struct PrunedTraversal {
  IdRange<KeyframeId> keyframes;
  ScanRange scans;
  KeyframeId anchor{};  ///< the nearest keyframe of those that are never pruned, from another time
};

/// What the backend is to prune, so that memory and time do not grow with every lap through known space.
struct Pruning {
  std::vector<PrunedTraversal> traversals;  ///< in order
  IdRanges<KeyframeId> keyframes;           ///< of all traversals
  IdRanges<ScanId> scans;
  IdRanges<TraversalId> ids;  ///< of the traversals
  std::size_t scan_count = 0;
  std::size_t seeing_count = 0;  ///< of those, with returns
  [[nodiscard]] bool empty() const { return traversals.empty(); }
  void add(const PrunedTraversal& traversal, const ScanStore& store);
};

/// Chooses traversals to prune, the oldest first. The place of a traversal is given by coarse tiles: in those
/// that hold most of its returns, several traversals before it and several after it must remain. So the first
/// layers of every place stay for good, and hold the map together; the newest stay, because things change;
/// those in between go. Hess et al. 2016 trim overlapping submaps in a similar way, but keep only the newest.
/// The anchors of earlier prunings stay. One thread at a time; allocates.
class Pruner {
 public:
  /// Views its arguments, which must outlive it.
  Pruner(const BackendConfig& config, const ScanStore& scans, const KeyframeChain& chain)
      : config_(&config), scans_(&scans), chain_(&chain), due_at_(max_scans()) {}

  /// What is to be pruned now: mostly empty, and always until there are config.max_scans scans with returns.
  /// Nothing from keyframe `first_in_use` on is touched, nor what was travelled last. `may_wait`: it is put
  /// off until there are as many scans more as are pruned at a time.
  [[nodiscard]] Pruning next(const KeyframePoses& T_map_keyframe, KeyframeId first_in_use,
                             bool may_wait = false);
  /// At least `scans_wanted` scans with returns, or all that can be spared of what lies before
  /// `first_recent`.
  [[nodiscard]] Pruning plan(const KeyframePoses& T_map_keyframe, KeyframeId first_recent,
                             std::size_t scans_wanted) const;
  /// The anchors of what is pruned stay from now on.
  void keep_anchors(const Pruning& pruning);

 private:
  [[nodiscard]] std::size_t max_scans() const { return static_cast<std::size_t>(config_->max_scans); }
  [[nodiscard]] KeyframeId first_recent(KeyframeId first_in_use) const;

  const BackendConfig* config_;
  const ScanStore* scans_;
  const KeyframeChain* chain_;
  std::size_t due_at_ = 0;           // that many scans
  std::vector<KeyframeId> anchors_;  // of what was pruned, ascending
};

/// What holds the ends of the holes to the anchors: from now on no motion does. No end is known better by its
/// tie than it was by the graph. An end that no motion held before has its tie from an earlier pruning, or
/// needs none. Allocates.
[[nodiscard]] std::vector<RelativePoseFactor<KeyframeId>> ties_around(const Pruning& pruning,
                                                                      const ScanStore& scans,
                                                                      const PoseGraph& graph,
                                                                      const BackendTuning& tuning = {});

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/store/keyframe_chain.hpp"
#include "core/backend/store/scan_store.hpp"
#include "core/base/ids.hpp"

namespace swiftlet {

/// A traversal over space that others know well, which is to be forgotten.
struct PrunedTraversal {
  IdRange<KeyframeId> keyframes;
  ScanRange scans;
  KeyframeId anchor{};  ///< the nearest keyframe of those that are never pruned, from another time
};

/// What the backend is to forget, so that memory and time do not grow with every lap through known space.
struct Pruning {
  std::vector<PrunedTraversal> traversals;  ///< in order
  IdRanges<KeyframeId> keyframes;           ///< the same, of all traversals
  IdRanges<ScanId> scans;
  std::size_t scan_count = 0;
  [[nodiscard]] bool empty() const { return traversals.empty(); }
};

/// Chooses traversals to prune, the oldest first, until at least `scans_wanted` scans are found or no more
/// can be spared. The place of a traversal is told by coarse tiles: in those that hold most of its returns,
/// several traversals before it and several after it must remain. So the first layers of every place stay for
/// good, and hold the map together; the newest stay, because things change; what goes is in between. Like the
/// trimming of overlapping submaps in Hess et al. 2016, but with the oldest kept. Nothing from keyframe
/// `first_recent` on is touched, nor are the `anchors` of earlier prunings. `other_time_m`: travel between a
/// traversal and its anchor. Allocates.
[[nodiscard]] Pruning plan_pruning(const ScanStore& scans, const KeyframeChain& chain,
                                   const KeyframePoses& T_map_keyframe, std::span<const KeyframeId> anchors,
                                   KeyframeId first_recent, double other_time_m, std::size_t scans_wanted);

/// What holds the ends of the holes to the anchors: from now on no motion does. An end that no motion held
/// before has its tie from an earlier pruning, or needs none. Allocates.
[[nodiscard]] std::vector<RelativePoseFactor<KeyframeId>> ties_around(const Pruning& pruning,
                                                                      const ScanStore& scans,
                                                                      const KeyframePoses& T_map_keyframe);

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/backend/keyframe_chain.hpp"
#include "core/backend/pose_graph.hpp"
#include "core/backend/scan_store.hpp"
#include "core/base/ids.hpp"
#include "core/base/index_removal.hpp"

namespace swiftlet {

/// A pass over space that others know well, which is to be forgotten.
struct RetiredPass {
  IndexRange keyframes;
  IndexRange scans;
  KeyframeId anchor{};  ///< the nearest keyframe of those that are never retired, from another time
};

/// What the backend is to forget, so that memory and time do not grow with every lap through known space.
struct Retirement {
  std::vector<RetiredPass> passes;  ///< in order
  IndexRemoval keyframes;           ///< the same, of all passes
  IndexRemoval scans;
  [[nodiscard]] bool empty() const { return passes.empty(); }
};

/// Chooses passes to retire, the oldest first, until at least `scans_wanted` scans are found or no more can
/// be spared. The place of a pass is told by coarse tiles: in those that hold most of its returns, several
/// passes before it and several after it must remain. So the first layers of every place stay for good, and
/// hold the map together; the newest stay, because things change; what goes is in between. Like the trimming
/// of overlapping submaps in Hess et al. 2016, but with the oldest kept. Nothing from keyframe `first_recent`
/// on is touched, nor are the `anchors` of earlier retirements. `other_time_m`: travel between a pass and its
/// anchor. Allocates.
[[nodiscard]] Retirement plan_retirement(const ScanStore& scans, const KeyframeChain& chain,
                                         std::span<const Pose2> T_map_keyframe,
                                         std::span<const KeyframeId> anchors, KeyframeId first_recent,
                                         double other_time_m, std::size_t scans_wanted);

/// What holds the ends of the holes to the anchors: from now on no motion does. An end that no motion held
/// before has its tie from an earlier retirement, or needs none. Numbered as before the retirement.
/// Allocates.
[[nodiscard]] std::vector<PoseConstraint> ties_around(const Retirement& retirement, const ScanStore& scans,
                                                      std::span<const Pose2> T_map_keyframe);

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <span>
#include <vector>

#include "core/backend/pose_graph/pose_graph.hpp"
#include "core/backend/store/keyframe_chain.hpp"
#include "core/backend/store/scan_store.hpp"

namespace swiftlet {

/// Dead reckoning of which the graph doubts: it slipped, jumped, or the vehicle was carried meanwhile.
struct DoubtedMotion {
  ScanRange scans;      ///< that it leads to, from keyframe to keyframe
  double weight = 1.0;  ///< on its information: 1 nothing speaks against it, towards 0 it is refused
};

/// As DCS weighted them last; those that were wrong have weight 0. Allocates.
[[nodiscard]] std::vector<DoubtedMotion> doubted_motions(const PoseGraph& graph, const KeyframeChain& chain);

/// Weakens dead reckoning: `steps[i]` leads to scan i + 1 of the range. What little is known of a motion that
/// was not measured stays.
void weaken_doubted(std::span<const DoubtedMotion> doubted, const ScanStore& scans, const ScanRange& range,
                    std::span<RelativePoseFactor<PoseIndex>> steps);

}  // namespace swiftlet

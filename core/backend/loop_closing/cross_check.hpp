// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <vector>

#include "core/backend/loop_closing/submap.hpp"
#include "core/backend/store/keyframe_chain.hpp"
#include "core/backend/store/scan_store.hpp"

namespace swiftlet {

/// The hits of scans `in`, newest first, one per cell: hovering in place must not outvote the flight.
/// `T_w_keyframe`: the keyframes in one continuous frame; `T_frame_w` leads from it to that of the result.
/// Allocates.
std::vector<Point2> thinned_hits(const ScanStore& scans, const KeyframeChain& chain, const ScanRange& in,
                                 const KeyframePoses& T_w_keyframe, const Pose2& T_frame_w, double cell_m);

/// Holds a match of the recent travel against an earlier submap the other way round: the submap's hits, laid
/// into a grid of the recent travel. Where a match is false they lie in what was just seen free. Views its
/// arguments, which must outlive it. One thread at a time; allocates.
class CrossCheck {
 public:
  /// `recent`: the scans that were matched, the newest made `query`. `T_w_keyframe`: as above. Of a submap
  /// whose scans were pruned in part, those that are left count.
  CrossCheck(const BackendConfig& config, const ScanStore& scans, const KeyframeChain& chain,
             const ScanRange& recent, KeyframeId query, const KeyframePoses& T_w_keyframe)
      : config_(config),
        scans_(scans),
        chain_(chain),
        recent_(recent),
        query_(query),
        T_w_keyframe_(T_w_keyframe) {}

  /// Whether enough of the submap's hits lie on ground that the recent travel has seen, and most of those on
  /// its walls. The grid is drawn at the first call.
  bool holds(const Submap& submap, const Pose2& T_submap_query);

 private:
  [[nodiscard]] Submap draw_recent() const;

  const BackendConfig& config_;
  const ScanStore& scans_;
  const KeyframeChain& chain_;
  ScanRange recent_;
  KeyframeId query_;
  const KeyframePoses& T_w_keyframe_;
  std::optional<Submap> drawn_;
};

}  // namespace swiftlet

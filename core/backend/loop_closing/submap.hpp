// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <cstdint>
#include <vector>

#include "core/backend/config/backend_config.hpp"
#include "core/backend/store/keyframe_chain.hpp"
#include "core/base/ids.hpp"
#include "core/geometry/grid.hpp"

namespace swiftlet {

/// A stretch of travel as a grid of occupancy probabilities in the frame of its reference keyframe, with the
/// max kernel of eq. 22 applied. Immutable once built: shared as shared_ptr<const Submap>. A byte holds
/// 255 * p(occupied); unknown cells hold 0.
struct Submap {
  KeyframeId reference{};   ///< its frame: the keyframe in the middle
  ScanRange scans;          ///< that were drawn; some may have been pruned since
  StoreyId storey{};        ///< of all of them
  double end_path_m = 0.0;  ///< travelled from the start of the run to its end
  GridGeometry geometry;
  std::vector<std::uint8_t> cells;  ///< row by row, with the kernel
  Point2 low_m;                     ///< box around all hits and the path, in the submap's frame
  Point2 high_m;
};

/// Draws the scans made from keyframe `first` up to, not including, `last`. `T_w_keyframe`: the keyframes in
/// one continuous frame.
/// Precondition: first < last, and the scans are of one storey. Allocates.
Submap build_submap(KeyframeId first, KeyframeId last, const ScanStore& scans, const KeyframeChain& chain,
                    const KeyframePoses& T_w_keyframe, const BackendConfig& config);

}  // namespace swiftlet

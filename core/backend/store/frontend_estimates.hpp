// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <optional>
#include <vector>

#include "core/backend/store/keyframe_chain.hpp"
#include "core/sensing/keyframe.hpp"
#include "core/sensing/wall_axis.hpp"

namespace swiftlet {

/// A wall in the frame of the keyframe that saw it last.
struct Wall {
  LandmarkId id{};
  KeyframeId anchor{};
  Point2 start_keyframe;
  Point2 end_keyframe;
};

/// The frontend's latest estimates: keyframes in its continuous frame, and walls. One thread at a time;
/// allocates.
class FrontendEstimates {
 public:
  /// State copying (eq. 20): the keyframe's window replaces earlier estimates of its keyframes.
  void take(const Keyframe& made);
  void erase(const IdRanges<KeyframeId>& pruned);

  [[nodiscard]] const KeyframePoses& T_local_keyframe() const { return T_local_keyframe_; }
  /// In the order of their ids.
  [[nodiscard]] const std::vector<Wall>& walls() const { return walls_; }
  /// The axis of the walls that were seen over the last `reach_m` of travel, in the frame of the newest
  /// keyframe; walls from before an unknown motion are left out.
  [[nodiscard]] std::optional<WallAxis> wall_axis_around_newest(const KeyframeChain& chain, double reach_m,
                                                                const WallAxisTuning& tuning) const;

 private:
  void take_walls(const Keyframe& made);

  KeyframePoses T_local_keyframe_;
  std::vector<Wall> walls_;
  KeyframeId motion_known_since_{};  // the first keyframe that measured motion joins to the newest
};

}  // namespace swiftlet

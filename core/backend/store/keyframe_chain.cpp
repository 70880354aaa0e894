// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/store/keyframe_chain.hpp"

#include <span>

namespace swiftlet {

/// Keyframes with poses are those of the chain, so they lie at the same positions.
KeyframeChain::Stretch KeyframeChain::stretch_after(KeyframeId keyframe,
                                                    const KeyframePoses& T_w_keyframe) const {
  const std::size_t k = scan_of_keyframe_.position(keyframe);
  const std::span<const ScanId> scans = scan_of_keyframe_.values();
  const std::span<const Pose2> poses = T_w_keyframe.values();
  Stretch stretch{poses[k], scans_->all().position(scans[k]), 0, {}};
  if (k + 1 >= scans.size() || k + 1 >= poses.size()) return stretch;
  const std::size_t last = scans_->all().position(scans[k + 1]);
  stretch.steps = last - stretch.first;
  const std::span<const StoredScan> stored = scans_->all().values();
  if (stored[last].starts_segment) return stretch;
  const Pose2 T_k_next_dead = between(stored[stretch.first].T_dead_body, stored[last].T_dead_body);
  stretch.missed = between(T_k_next_dead, between(poses[k], poses[k + 1]));
  return stretch;
}

Pose2 KeyframeChain::T_w_body(std::size_t position, const Stretch& stretch) const {
  const Pose2 T_w_dead = stretch.T_w_keyframe * scans_->all().values()[position].T_keyframe_body;
  if (!stretch.missed) return T_w_dead;
  const Pose2& missed = *stretch.missed;
  const double fraction = static_cast<double>(position - stretch.first) / static_cast<double>(stretch.steps);
  return T_w_dead * Pose2(fraction * missed.x_m(), fraction * missed.y_m(), fraction * missed.yaw_rad());
}

Pose2 KeyframeChain::T_w_body(ScanId scan, const KeyframePoses& T_w_keyframe) const {
  return T_w_body(scans_->all().position(scan), stretch_after((*scans_)[scan].keyframe, T_w_keyframe));
}

std::vector<Pose2> KeyframeChain::T_w_bodies(const ScanRange& scans, const KeyframePoses& T_w_keyframe,
                                             std::size_t every) const {
  const std::size_t first = scans_->all().position(scans.first);
  const std::size_t end = scans_->all().position(scans.end);
  const std::span<const StoredScan> stored = scans_->all().values();
  std::vector<Pose2> poses;
  poses.reserve((end - first) / every + 1);
  Stretch stretch;
  for (std::size_t i = first; i < end; i += every) {
    if (i == first || stored[i].keyframe != stored[i - every].keyframe)
      stretch = stretch_after(stored[i].keyframe, T_w_keyframe);
    poses.push_back(T_w_body(i, stretch));
  }
  return poses;
}

}  // namespace swiftlet

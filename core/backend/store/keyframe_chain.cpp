// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/store/keyframe_chain.hpp"

namespace swiftlet {

KeyframeChain::Stretch KeyframeChain::stretch_after(KeyframeId keyframe,
                                                    std::span<const Pose2> T_w_keyframe) const {
  const std::size_t k = index_of(keyframe);
  if (k + 1 >= scan_of_keyframe_.size() || k + 1 >= T_w_keyframe.size()) return {};
  Stretch stretch{scan_of_keyframe_[k], scan_of_keyframe_[k + 1], {}};
  const StoredScan& last = (*scans_)[stretch.last];
  if (last.starts_segment) return stretch;
  const Pose2 T_k_next_dead = between((*scans_)[stretch.first].T_dead_body, last.T_dead_body);
  stretch.missed = between(T_k_next_dead, between(T_w_keyframe[k], T_w_keyframe[k + 1]));
  return stretch;
}

Pose2 KeyframeChain::T_w_body(ScanIndex scan, const Stretch& stretch,
                              std::span<const Pose2> T_w_keyframe) const {
  const StoredScan& at = (*scans_)[scan];
  const Pose2 T_w_dead = T_w_keyframe[index_of(at.keyframe)] * at.T_keyframe_body;
  if (!stretch.missed) return T_w_dead;
  const Pose2& missed = *stretch.missed;
  const double fraction =
      static_cast<double>(scan - stretch.first) / static_cast<double>(stretch.last - stretch.first);
  return T_w_dead * Pose2(fraction * missed.x_m(), fraction * missed.y_m(), fraction * missed.yaw_rad());
}

Pose2 KeyframeChain::T_w_body(ScanIndex scan, std::span<const Pose2> T_w_keyframe) const {
  return T_w_body(scan, stretch_after((*scans_)[scan].keyframe, T_w_keyframe), T_w_keyframe);
}

std::vector<Pose2> KeyframeChain::T_w_bodies(const ScanRange& scans, std::span<const Pose2> T_w_keyframe,
                                             ScanIndex every) const {
  std::vector<Pose2> poses;
  poses.reserve(scans.size() / every + 1);
  Stretch stretch;
  for (ScanIndex i = scans.first; i < scans.end; i += every) {
    const KeyframeId keyframe = (*scans_)[i].keyframe;
    if (i == scans.first || keyframe != (*scans_)[i - every].keyframe)
      stretch = stretch_after(keyframe, T_w_keyframe);
    poses.push_back(T_w_body(i, stretch, T_w_keyframe));
  }
  return poses;
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/backend/keyframe_chain.hpp"

namespace swiftlet {

Pose2 KeyframeChain::T_w_body(ScanIndex scan, std::span<const Pose2> T_w_keyframe) const {
  const StoredScan& at = (*scans_)[scan];
  const std::size_t k = index_of(at.keyframe);
  const Pose2 T_w_dead = T_w_keyframe[k] * at.T_keyframe_body;
  if (k + 1 >= scan_of_keyframe_.size() || k + 1 >= T_w_keyframe.size()) return T_w_dead;
  const ScanIndex first = scan_of_keyframe_[k];
  const ScanIndex last = scan_of_keyframe_[k + 1];
  if ((*scans_)[last].starts_segment) return T_w_dead;

  const Pose2 T_k_next_dead = between((*scans_)[first].T_dead_body, (*scans_)[last].T_dead_body);
  const Pose2 T_k_next = between(T_w_keyframe[k], T_w_keyframe[k + 1]);
  const Pose2 missed = between(T_k_next_dead, T_k_next);
  const double fraction = static_cast<double>(scan - first) / static_cast<double>(last - first);
  return T_w_dead * Pose2(fraction * missed.x_m(), fraction * missed.y_m(), fraction * missed.yaw_rad());
}

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "tools/evaluation/confidence_history.hpp"

namespace swiftlet {

void ConfidenceHistory::look() {
  const IdMap<ScanId, StoredScan>& scans = backend_->scans().all();
  if (scans.end_id() == seen_) return;
  seen_ = scans.end_id();
  const StoredScan& scan = scans.values().back();
  const bool is_keyframe = backend_->keyframes().all().values().back() == scans.last_id();
  const Tracking tracking = backend_->tracking().tracking;
  if (is_keyframe) newest_ = backend_->confidence();
  const Pose2 T_local_body = newest_.T_local_keyframe * scan.T_keyframe_body;
  poses_.push_back({.stamp = scan.stamp,
                    .path_m = scan.path_m,
                    .T_map_body = scan.T_map_live,
                    .from_start = carried_on(newest_.from_start, newest_, T_local_body),
                    .is_tracked = tracking == Tracking::kTracking,
                    .from_surroundings = carried_on(newest_.from_surroundings, newest_, T_local_body),
                    .state = name_of(tracking)});
}

}  // namespace swiftlet

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
  const bool is_tracked = backend_->tracking().tracking == Tracking::kTracking;
  if (is_keyframe) newest_ = backend_->confidence();
  poses_.push_back({scan.stamp, scan.path_m, scan.T_map_live,
                    carried_on(newest_.from_start, newest_, newest_.T_local_keyframe * scan.T_keyframe_body),
                    is_tracked});
}

}  // namespace swiftlet

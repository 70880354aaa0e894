// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <span>

#include "core/backend/store/keyframe_chain.hpp"
#include "core/backend/store/scan_store.hpp"
#include "tests/support/dead_reckoning_frontend.hpp"

namespace swiftlet {

/// What a backend holds of a flight before it looks for loops: scans, chain and the frontend's keyframes. The
/// frontend's path is the odometry, or `T_dead_body` of each sample.
class StoredRun {
 public:
  explicit StoredRun(std::span<const RangeSample> samples, std::span<const Pose2> T_dead_body = {}) {
    DeadReckoningFrontend frontend;
    for (const RangeSample& sample : samples) {
      FrontendStep step = frontend.process(sample);
      if (!T_dead_body.empty()) step.T_local_body = step.T_dead_body = T_dead_body[scans_.size()];
      const ScanId scan = scans_.add(step);
      if (!step.has_keyframe) continue;
      chain_.add(scan);
      T_local_keyframe_.push_back(step.T_local_body);
    }
  }
  StoredRun(const StoredRun&) = delete;  // the chain views the scans
  StoredRun& operator=(const StoredRun&) = delete;

  [[nodiscard]] const ScanStore& scans() const { return scans_; }
  [[nodiscard]] const KeyframeChain& chain() const { return chain_; }
  [[nodiscard]] const KeyframePoses& T_local_keyframe() const { return T_local_keyframe_; }
  [[nodiscard]] KeyframeId newest() const { return T_local_keyframe_.last_id(); }

 private:
  ScanStore scans_{BeamLayout::multiranger()};
  KeyframeChain chain_{scans_};
  KeyframePoses T_local_keyframe_;
};

}  // namespace swiftlet
